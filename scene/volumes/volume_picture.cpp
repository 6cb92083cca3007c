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

}  // namespace tools

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
