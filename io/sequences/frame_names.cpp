#include "io/sequences/frame_names.h"

#include <charconv>
#include <cstdlib>
#include <string_view>
#include <unordered_set>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

constexpr int kFarthestFrame = 9999999;
constexpr std::size_t kMostFrames = 1000000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A place for the number at `at`: its length in the name and how many digits it wants.
struct Place {
  std::size_t length = 0;  // 0: none
  std::size_t digits = 1;
  bool sign_counts = false;  // printf's width includes the minus
};

Place place_at(std::string_view name, std::size_t at) {
  if (name[at] == '#') {
    std::size_t end = at;
    while (end < name.size() && name[end] == '#') ++end;
    return {end - at, end - at};
  }
  const bool houdini = name.substr(at).starts_with("$F");
  if (!houdini && name[at] != '%') return {};
  std::size_t end = at + (houdini ? 2 : 1);
  // printf's width without a leading 0 would pad with blanks, which no file name wants.
  if (!houdini && end < name.size() && name[end] != 'd' && name[end] != '0') return {};
  std::size_t digits = 0;
  for (; end < name.size() && is_digit(name[end]); ++end) {
    digits = digits * 10 + static_cast<std::size_t>(name[end] - '0');
    if (digits > 99) return {};
  }
  if (!houdini && (end == name.size() || name[end++] != 'd')) return {};
  return {end - at, std::max<std::size_t>(digits, 1), !houdini};
}

bool read_number(std::string_view* text, int* value) {
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), *value);
  if (error != std::errc()) return false;
  text->remove_prefix(static_cast<std::size_t>(end - text->data()));
  return *value >= -kFarthestFrame && *value <= kFarthestFrame;
}

bool skip(char c, std::string_view* text) {
  if (!text->starts_with(c)) return false;
  text->remove_prefix(1);
  return true;
}

// One part of the list, such as 1-240x2.
bool parse_part(std::string_view part, int* first, int* last, int* step) {
  *step = 1;
  if (!read_number(&part, first)) return false;
  *last = *first;
  if (part.empty()) return true;
  if (!skip('-', &part) || !read_number(&part, last)) return false;
  if (!part.empty() && (!skip('x', &part) || !read_number(&part, step))) return false;
  return part.empty() && *last >= *first && *step >= 1;
}

}  // namespace

bool has_frame_number(const std::string& name) {
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (place_at(name, at).length > 0) return true;
  }
  return false;
}

std::string name_of_frame(const std::string& name, int frame) {
  std::string out;
  for (std::size_t at = 0; at < name.size();) {
    const Place place = place_at(name, at);
    if (place.length == 0) {
      out += name[at++];
      continue;
    }
    const std::size_t sign = frame < 0 && !place.sign_counts ? 1 : 0;
    out += fmt::format("{:0{}d}", frame, place.digits + sign);
    at += place.length;
  }
  return out;
}

Status parse_frames(const std::string& text, std::vector<int>* frames) {
  std::vector<int> list;
  std::unordered_set<int> seen;
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = rest.find(',');
    int first = 0, last = 0, step = 1;
    if (!parse_part(rest.substr(0, comma), &first, &last, &step)) {
      return invalid_argument(fmt::format(
          "--frames is '{}'; it must be a list such as 1-240, 1-240x2 (every second) or 1,5,10-20",
          text));
    }
    for (int frame = first; frame <= last; frame += step) {
      if (seen.insert(frame).second) list.push_back(frame);
      if (list.size() > kMostFrames) {
        return invalid_argument(
            fmt::format("--frames is '{}'; it must be at most {} frames", text, kMostFrames));
      }
    }
    if (comma == rest.npos) break;
    rest.remove_prefix(comma + 1);
  }
  *frames = std::move(list);
  return {};
}

Status parse_shard(const std::string& text, Shard* shard) {
  std::string_view rest = text;
  Shard s;
  if (read_number(&rest, &s.index) && skip('/', &rest) && read_number(&rest, &s.count) &&
      rest.empty() && s.index >= 1 && s.index <= s.count) {
    *shard = s;
    return {};
  }
  return invalid_argument(
      fmt::format("--shard is '{}'; it must be I/N with 1 <= I <= N, such as 1/5", text));
}

}  // namespace obscura::tools
