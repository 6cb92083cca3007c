// Which channels of an EXR file are depth, back depth and normals.
#include <algorithm>
#include <cctype>
#include <initializer_list>

#include "fmt/format.h"
#include "fmt/ranges.h"
#include "support/files/depth_file.h"

namespace obscura::support {
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

bool looks_like_depth(const std::string& channel) {
  const NameParts n(channel);
  if (contains(n.last, "back") || contains(n.layer, "back")) return false;
  const bool depth_layer = contains(n.layer, "depth") || n.layer == "z";
  if (n.last == "z") return n.layer.empty() || depth_layer;
  if (n.last == "v" || n.last == "r" || n.last == "y") return depth_layer;
  return contains(n.last, "depth");
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
  if (header.find("Z")) {
    *depth = "Z";
    return {};
  }
  std::vector<std::string> found;
  for (const auto& c : header.channels) {
    if (looks_like_depth(c.name)) found.push_back(c.name);
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

bool find_vector(const ExrHeader& header, const std::string& prefix, std::string names[3]) {
  for (const char* axes : {"XYZ", "xyz", "RGB", "rgb"}) {
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

Status choose_normals(const std::string& path, const ExrHeader& header, const std::string& wanted,
                      std::string names[3]) {
  if (wanted == "none") return {};
  if (wanted != "auto") {
    if (find_vector(header, wanted, names)) return {};
    return invalid_input(fmt::format("{}: no channels {}.X, {}.Y, {}.Z (normals); it has {}", path,
                                     wanted, wanted, wanted, channel_list(header)));
  }
  if (find_vector(header, "N", names)) return {};
  for (const auto& c : header.channels) {
    const NameParts n(c.name);
    const bool first_axis = n.last == "x" || n.last == "r";
    if (first_axis && (n.layer == "n" || n.layer == "normal" || n.layer == "normals") &&
        find_vector(header, c.name.substr(0, c.name.rfind('.')), names)) {
      return {};
    }
  }
  return {};
}

}  // namespace

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
  } else if (header.find("ZBack")) {
    choice->back_depth = "ZBack";
  }
  return choose_normals(path, header, options.normals, choice->normals);
}

}  // namespace obscura::support
