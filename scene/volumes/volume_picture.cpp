#include "scene/volumes/volume_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/images/view_size.h"

namespace obscura {
namespace tools {

Image picture_of_light(const Image& light, const Image& coverage, const PictureColours& colours,
                       float gamma) {
  Image picture(light.width, light.height);
  const std::size_t pixels = light.channels[0].values.size();
  const char* const names[3] = {"R", "G", "B"};
  for (int k = 0; k < 3; ++k) {
    const float surface = std::pow(colours.surface[k], gamma);
    const float background = std::pow(colours.background[k], gamma);
    std::vector<float>& out = picture.add(names[k]);
    for (std::size_t i = 0; i < pixels; ++i) {
      const float open = 1 - coverage.channels[0].values[i];
      const float lit = std::max(light.channels[0].values[i] - open, 0.0f);
      out[i] = std::pow(surface * lit + background * open, 1 / gamma);
    }
  }
  return picture;
}

void add_outer_layer(const OuterLayer& layer, const Image& inner_depth, const OuterSurface& outer,
                     float gamma, Image* picture) {
  constexpr float kLeastFacing = 0.1f;  // a shell seen along its side has an end
  const std::size_t pixels = inner_depth.channels[0].values.size();
  float colour[3];
  for (int k = 0; k < 3; ++k) colour[k] = std::pow(outer.colour[k], gamma);
  for (std::size_t i = 0; i < pixels; ++i) {
    const float covered = layer.coverage.channels[0].values[i];
    const bool behind = inner_depth.channels[0].values[i] <= layer.depth.channels[0].values[i];
    if (covered == 0 || behind) continue;
    const float open = 1 - covered;
    const float facing = (layer.facing.channels[0].values[i] - open) / covered;
    const float lit = std::max((layer.light.channels[0].values[i] - open) / covered, 0.0f);
    const float through = std::pow(1 - outer.opacity, 1 / std::clamp(facing, kLeastFacing, 1.0f));
    const float opacity = covered * (1 - through);
    for (int k = 0; k < 3; ++k) {
      float& v = picture->channels[k].values[i];
      v = std::pow((1 - opacity) * std::pow(v, gamma) + opacity * lit * colour[k], 1 / gamma);
    }
  }
}

}  // namespace tools

bool SettingText<tools::OptionalIsovalue>::parse(std::string_view text,
                                                 tools::OptionalIsovalue* value) {
  double number;
  if (!parse_number(text, &number) || !std::isfinite(static_cast<float>(number))) return false;
  value->emplace(static_cast<float>(number));
  return true;
}

std::string SettingText<tools::OptionalIsovalue>::write(const tools::OptionalIsovalue& value) {
  return value ? fmt::format("{:g}", *value) : "";
}

bool SettingText<tools::Colour>::parse(std::string_view text, tools::Colour* value) {
  double n[3];
  if (!tools::parse_numbers(text, ',', 3, n)) return false;
  for (const double v : n) {
    if (!(v >= 0 && v <= 1)) return false;
  }
  *value = {float(n[0]), float(n[1]), float(n[2])};
  return true;
}

std::string SettingText<tools::Colour>::write(const tools::Colour& value) {
  return fmt::format("{:g},{:g},{:g}", value[0], value[1], value[2]);
}

}  // namespace obscura
