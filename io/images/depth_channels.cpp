// Which channels of an EXR file are depth, back depth and normals.
#include <algorithm>
#include <cctype>
#include <initializer_list>

#include "fmt/format.h"
#include "fmt/ranges.h"
#include "io/images/depth_file.h"

namespace obscura::tools {
namespace {

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

// A channel's name in lower case, cut at its dots: the last part and the one before.
struct NameParts {
  std::string layer, last;

  explicit NameParts(const std::string& channel) {
    const std::string name = lower(channel);
    const auto dot = name.rfind('.');
    last = dot == std::string::npos ? name : name.substr(dot + 1);
    if (dot == std::string::npos || dot == 0) return;
    const auto before = name.rfind('.', dot - 1);
    layer = name.substr(before == std::string::npos ? 0 : before + 1,
                        dot - (before == std::string::npos ? 0 : before + 1));
  }
};

bool contains(const std::string& s, const char* part) { return s.find(part) != std::string::npos; }

// How much a name looks like depth: 3 for Z itself, 2 for a Z of no layer or of a depth layer, 1
// for another value of a depth layer or a name that has "depth" in it, 0 for any other.
int depth_rank(const std::string& channel) {
  const NameParts n(channel);
  if (contains(n.last, "back") || contains(n.layer, "back")) return 0;
  if (channel == "Z") return 3;
  const bool depth_layer = contains(n.layer, "depth") || n.layer == "z";
  if (n.last == "z" && (depth_layer || n.layer.empty())) return 2;
  const bool only_value = n.last == "v" || n.last == "r" || n.last == "red" || n.last == "y";
  return (only_value && depth_layer) || contains(n.last, "depth") ? 1 : 0;
}

std::string channel_list(const ExrHeader& header) {
  std::vector<std::string> names;
  for (const auto& c : header.channels) names.push_back(c.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Status choose_depth(const std::string& path, const ExrHeader& header, const std::string& wanted,
                    std::string* depth) {
  if (!wanted.empty()) {
    if (!header.find(wanted)) {
      return invalid_input(fmt::format("{}: no channel '{}' (depth-channel); it has {}", path,
                                       wanted, channel_list(header)));
    }
    *depth = wanted;
    return {};
  }
  std::vector<std::string> found;
  int best = 1;
  for (const auto& c : header.channels) {
    const int rank = depth_rank(c.name);
    if (rank < best) continue;
    if (rank > best) found.clear();
    best = rank;
    found.push_back(c.name);
  }
  if (found.size() == 1) {
    *depth = found[0];
    return {};
  }
  if (found.empty()) {
    return invalid_input(fmt::format("{}: no depth channel; name one with depth-channel; it has {}",
                                     path, channel_list(header)));
  }
  return invalid_input(
      fmt::format("{}: several channels may be depth ({}); name one with "
                  "depth-channel",
                  path, fmt::join(found, ", ")));
}

// What comes before the last two parts of a name: "ViewLayer." of ViewLayer.Depth.Z.
std::string view_of(const std::string& channel) {
  const auto last = channel.rfind('.');
  if (last == std::string::npos || last == 0) return "";
  const auto layer = channel.rfind('.', last - 1);
  return layer == std::string::npos ? "" : channel.substr(0, layer + 1);
}

// Of several names the only one, or the only one in the same view as depth; "" otherwise.
std::string only_one(const std::vector<std::string>& names, const std::string& view) {
  if (names.size() == 1) return names[0];
  std::string found;
  for (const std::string& name : names) {
    if (view_of(name + (name.back() == '.' ? "X" : "")) != view) continue;
    if (!found.empty()) return "";
    found = name;
  }
  return found;
}

std::string find_back_depth(const ExrHeader& header, const std::string& depth) {
  if (header.find("ZBack")) return "ZBack";
  std::vector<std::string> found;
  for (const auto& c : header.channels) {
    if (looks_like_back_depth(c.name) && c.name != depth) found.push_back(c.name);
  }
  return only_one(found, view_of(depth));
}

std::string drop_dot(const std::string& prefix) { return prefix.substr(0, prefix.size() - 1); }

bool find_vector(const ExrHeader& header, const std::string& prefix, std::string names[3]) {
  static constexpr const char* kAxes[][3] = {
      {"X", "Y", "Z"}, {"x", "y", "z"}, {"R", "G", "B"}, {"r", "g", "b"}, {"red", "green", "blue"}};
  for (const auto& axes : kAxes) {
    for (const char* dot : {".", ""}) {
      bool all = true;
      for (int i = 0; i < 3; ++i) {
        names[i] = prefix + dot + axes[i];
        all = all && header.find(names[i]);
      }
      if (all) return true;
    }
  }
  for (int i = 0; i < 3; ++i) names[i].clear();
  return false;
}

Status choose_normals(const std::string& path, const ExrHeader& header,
                      const DepthFileOptions& options, const std::string& depth,
                      std::string names[3]) {
  const std::string& wanted = options.normals;
  if (wanted == "none" || wanted == "depth") return {};
  if (wanted != "auto") {
    if (find_vector(header, wanted, names)) return {};
    return invalid_input(fmt::format("{}: no channels {}.X, {}.Y, {}.Z (normals); it has {}", path,
                                     wanted, wanted, wanted, channel_list(header)));
  }
  if (find_vector(header, "N", names)) return {};
  std::vector<std::string> found;  // prefixes with their dot
  for (const auto& c : header.channels) {
    const NameParts n(c.name);
    const bool first_axis = n.last == "x" || n.last == "r" || n.last == "red";
    const bool normal_layer =
        n.layer == "n" || n.layer == "normal" || n.layer == "normals" || n.layer == "vraynormals";
    const std::string prefix = c.name.substr(0, c.name.rfind('.') + 1);
    if (!first_axis || !normal_layer || !find_vector(header, drop_dot(prefix), names)) continue;
    if (found.empty() || found.back() != prefix) found.push_back(prefix);
  }
  for (int i = 0; i < 3; ++i) names[i].clear();
  if (found.empty()) return {};
  const std::string prefix = only_one(found, view_of(depth));
  if (!prefix.empty() && find_vector(header, drop_dot(prefix), names)) return {};
  return invalid_input(
      fmt::format("{}: several channels may be normals ({}X); name a prefix or none with normals",
                  path, fmt::join(found, "X, ")));
}

}  // namespace

bool looks_like_depth(const std::string& channel) { return depth_rank(channel) > 0; }

bool looks_like_back_depth(const std::string& channel) {
  std::string name = lower(channel);
  const auto at = name.find("back");
  return at != std::string::npos && looks_like_depth(name.erase(at, 4));
}

Status choose_exr_part(const std::string& path, const std::vector<ExrHeader>& parts,
                       const DepthFileOptions& options, int* part) {
  double number = -1;
  const bool numbered = parse_number(options.part, &number);
  std::string list;
  for (const ExrHeader& p : parts) {
    const bool named = !p.part_name.empty() && p.part_name == options.part;
    if (named || (numbered && number == p.part)) {
      *part = p.part;
      return {};
    }
    list += fmt::format("{}{}{} ({})", list.empty() ? "" : ", ", p.part,
                        p.part_name.empty() ? "" : " " + p.part_name, channel_list(p));
  }
  if (!options.part.empty()) {
    return invalid_input(
        fmt::format("{}: no part '{}'; its parts are {}", path, options.part, list));
  }
  for (const ExrHeader& p : parts) {
    std::string depth;
    if (!choose_depth(path, p, options.depth_channel, &depth).ok()) continue;
    *part = p.part;
    return {};
  }
  *part = 0;
  if (parts.size() == 1) return {};  // what is wrong is said by choose_exr_channels
  return invalid_input(
      fmt::format("{}: none of its parts has depth; name a channel with depth-channel; they are {}",
                  path, list));
}

Status choose_exr_channels(const std::string& path, const ExrHeader& header,
                           const DepthFileOptions& options, ExrChannelChoice* choice) {
  *choice = {};
  if (Status s = choose_depth(path, header, options.depth_channel, &choice->depth); !s.ok()) {
    return s;
  }
  if (!options.back_depth_channel.empty()) {
    if (!header.find(options.back_depth_channel)) {
      return invalid_input(fmt::format("{}: no channel '{}' (back-depth-channel); it has {}", path,
                                       options.back_depth_channel, channel_list(header)));
    }
    choice->back_depth = options.back_depth_channel;
  } else {
    choice->back_depth = find_back_depth(header, choice->depth);
  }
  return choose_normals(path, header, options, choice->depth, choice->normals);
}

}  // namespace obscura::tools
