#include <fmt/format.h>

#include <sstream>

#include "io/volumes/vdb_native.h"

namespace obscura::tools {
namespace {

constexpr const char* kFirstLine = "obscura-vdb 1";

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
  }
  constexpr std::size_t kMost = 300;
  if (text.size() > kMost) text.resize(kMost);
  return text;
}

}  // namespace

std::string write_vdb_header(const Status& status, const VolumeImage& image) {
  std::string text = fmt::format("{}\n{} {}\n", kFirstLine, static_cast<int>(status.code()),
                                 one_line(status.message()));
  if (status.ok()) {
    text += fmt::format("{} {} {}\n", image.size[0], image.size[1], image.size[2]);
    for (const Double3& v : {image.axes[0], image.axes[1], image.axes[2], image.origin, image.up}) {
      text += fmt::format("{} {} {}\n", v[0], v[1], v[2]);
    }
    text += fmt::format("{}\n{} {}\n", image.stored_type, int{image.isovalue.has_value()},
                        image.isovalue.value_or(0));
    for (const std::string& note : image.notes) text += one_line(note) + "\n";
  }
  return text + "\n";
}

Status parse_vdb_header(const std::string& path, const std::string& text, VolumeImage* image) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  int code = 0;
  if (line != kFirstLine || !(in >> code)) {
    return {StatusCode::kInternal, fmt::format("{}: obscura-vdb is of another version", path)};
  }
  in.get();
  std::getline(in, line);
  const bool known = code >= 0 && code <= static_cast<int>(StatusCode::kInternal);
  if (!known || (code != 0 && line.empty())) {
    return {StatusCode::kInternal, fmt::format("{}: obscura-vdb failed without a reason", path)};
  }
  if (code != 0) return {static_cast<StatusCode>(code), line};
  VolumeImage result;
  result.name = path;
  result.format = "OpenVDB";
  for (int& n : result.size) in >> n;
  for (Double3* v :
       {&result.axes[0], &result.axes[1], &result.axes[2], &result.origin, &result.up}) {
    for (double& x : *v) in >> x;
  }
  bool level_set = false;
  float isovalue = 0;
  in >> result.stored_type >> level_set >> isovalue;
  if (!in) return {StatusCode::kInternal, fmt::format("{}: obscura-vdb was cut short", path)};
  in.get();
  while (std::getline(in, line)) {
    if (!line.empty()) result.notes.push_back(line);
  }
  if (level_set) {
    result.isovalue = isovalue;
    result.solid = SolidSide::kBelow;
  }
  *image = std::move(result);
  return {};
}

}  // namespace obscura::tools
