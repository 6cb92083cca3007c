#include "io/images/describe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "io/images/depth_file.h"
#include "io/images/exr_camera.h"
#include "io/images/files.h"

namespace obscura::tools {
namespace {

Json describe_channel(const Image::Channel& channel, const std::string& type) {
  float lo = INFINITY, hi = -INFINITY;
  std::int64_t finite = 0, nan = 0, infinite = 0;
  for (float v : channel.values) {
    if (std::isnan(v)) {
      ++nan;
    } else if (std::isinf(v)) {
      ++infinite;
    } else {
      ++finite;
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  }
  Json json{{"name", channel.name}, {"type", type}};
  if (finite > 0) {
    json["min"] = lo;
    json["max"] = hi;
  }
  json["finite"] = finite;
  json["nan"] = nan;
  json["infinite"] = infinite;
  return json;
}

Json describe_window(const PixelWindow& w) {
  return std::array{w.min_x, w.min_y, w.max_x, w.max_y};
}

std::string describe_camera(const std::string& path, const ExrHeader& header) {
  if (!header.world_to_camera || !header.world_to_ndc) {
    return "not in the file; give fov-y, ortho-height, focal-length with sensor-height, or "
           "projection";
  }
  ExrCamera known;
  const PixelWindow& display = header.display_window;
  if (Status s = camera_from_exr(path, header, display, &known); !s.ok()) return s.message();
  const Camera& c = known.camera;
  if (c.orthographic) {
    return fmt::format("orthographic, height {:.6g}, from worldToCamera and worldToNDC",
                       c.scale_y * static_cast<float>(display.height()));
  }
  const double above = std::atan(double{c.center_v} * c.scale_y);
  const double below = std::atan((display.height() - double{c.center_v}) * c.scale_y);
  return fmt::format("perspective, fov-y {:.4f} degrees, from worldToCamera and worldToNDC",
                     (above + below) * 180 / std::numbers::pi);
}

// Whether depth is found.
bool describe_exr(const std::string& path, const ExrHeader& header, Json* json) {
  (*json)["display_window"] = describe_window(header.display_window);
  (*json)["data_window"] = describe_window(header.data_window);
  (*json)["attributes"] = header.attributes;
  ExrChannelChoice choice;
  const Status s = choose_exr_channels(path, header, {}, &choice);
  (*json)["depth"] = s.ok() ? choice.depth : s.message();
  if (!choice.back_depth.empty()) (*json)["back_depth"] = choice.back_depth;
  (*json)["normals"] =
      choice.normals[0].empty()
          ? std::string("none; reconstructed from depth")
          : fmt::format("{} {} {}", choice.normals[0], choice.normals[1], choice.normals[2]);
  (*json)["camera"] = describe_camera(path, header);
  return s.ok();
}

// What reading it as a depth image would say and decide, and a command that takes it.
void describe_reading(const std::string& path, bool has_camera, Json* json) {
  DepthFileOptions o;
  std::string options;
  if (!has_camera) {
    o.fov_y = 45;
    options += " --fov-y DEGREES";
  }
  if (file_ending(path) == ".png") {
    o.depth_scale = 1;
    options += " --depth-scale UNIT";
  }
  DepthInput input;
  if (Status s = load_depth_input(path, o, &input); !s.ok()) {
    (*json)["problem"] = s.message();
    return;
  }
  (*json)["notes"] = input.notes;
  (*json)["command"] = fmt::format("obscura ao {}{} -o ao.png", path, options);
}

Status describe_parts(const std::string& path, int* part, Json* json) {
  std::vector<ExrHeader> parts;
  if (Status s = read_exr_headers(path, &parts); !s.ok()) return s;
  *part = 0;
  if (parts.size() < 2) return {};
  Json list = Json::array();
  for (const ExrHeader& p : parts) {
    std::string channels;
    for (const auto& c : p.channels) channels += (channels.empty() ? "" : ", ") + c.name;
    list.push_back(fmt::format("{} {}: {}", p.part, p.part_name, channels));
  }
  (*json)["parts"] = std::move(list);
  if (Status s = choose_exr_part(path, parts, {}, part); !s.ok()) *part = 0;
  (*json)["part"] = *part;
  return {};
}

// A value for people. Names in a file may hold any bytes; none shall steer a terminal.
std::string as_text(const Json& value) {
  std::string text = value.is_string() ? value.text() : value.dump();
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  }
  return text;
}

}  // namespace

Status describe_image(const std::string& path, Json* description) {
  Json json{{"file", path}}, channels = Json::array();
  Image image;
  ExrHeader header;
  const bool exr = file_ending(path) == ".exr";
  int part = 0;
  if (exr) {
    if (Status s = describe_parts(path, &part, &json); !s.ok()) return s;
  }
  Status s = exr ? read_exr(path, {}, &header, &image, part) : read_image(path, &image);
  if (!s.ok()) return s;
  json["kind"] = file_ending(path).substr(1);
  json["width"] = image.width;
  json["height"] = image.height;
  const bool depth = exr ? describe_exr(path, header, &json)
                         : image.channels.size() == 1 && file_ending(path) != ".hdr";
  for (const Image::Channel& c : image.channels) {
    const auto* native = exr ? header.find(c.name) : nullptr;
    const char* type = file_ending(path) == ".png" ? "8 or 16 bits, as [0, 1]" : "float";
    channels.push_back(describe_channel(c, native ? native->type : type));
  }
  for (const ExrHeader::Channel& c : header.channels) {
    if (c.subsampled) channels.push_back({{"name", c.name}, {"type", c.type + ", subsampled"}});
  }
  json["channels"] = std::move(channels);
  if (depth) describe_reading(path, header.world_to_camera && header.world_to_ndc, &json);
  *description = std::move(json);
  return {};
}

std::string description_text(const Json& description) {
  std::string out;
  for (const auto& [key, value] : description.members()) {
    if (value.is_array() && !value.elements().empty() && value.elements()[0].is_object()) {
      out += key + ":\n";
      for (const Json& entry : value.elements()) {
        out += "  ";
        for (const auto& [name, field] : entry.members()) {
          const std::string text = as_text(field);
          out += name == "name" ? text : fmt::format("  {} {}", name, text);
        }
        out += "\n";
      }
    } else {
      const std::string text = as_text(value);
      out += fmt::format("{}: {}\n", key, text);
    }
  }
  return out;
}

}  // namespace obscura::tools
