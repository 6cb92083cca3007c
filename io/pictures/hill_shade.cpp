#include "io/pictures/hill_shade.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace obscura::tools {
namespace {

struct Stretch {
  float black = 0, white = 1;
};

Stretch find_stretch(const ImageView<const float>& light) {
  std::vector<float> values;
  // As many as tell the percentiles, evenly over the model.
  const int step = 1 + static_cast<int>(std::sqrt(double(light.width) * light.height / 4e6));
  for (int y = 0; y < light.height; y += step) {
    for (int x = 0; x < light.width; x += step) {
      if (!std::isnan(light(x, y))) values.push_back(light(x, y));
    }
  }
  if (values.empty()) return {};
  auto percentile = [&](double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  const float black = percentile(0.005), white = percentile(0.995);
  // Flat ground stays white instead of becoming noise.
  return {std::min(black, white - 0.02f), white};
}

}  // namespace

Image hill_shade(const ImageView<const float>& light) {
  const Stretch stretch = find_stretch(light);
  Image picture(light.width, light.height);
  for (const char* name : {"R", "G", "B"}) picture.add(name);
  constexpr float kNoData[] = {0.45f, 0.55f, 0.65f};
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const float v = light(x, y);
      const float share =
          std::clamp((v - stretch.black) / (stretch.white - stretch.black), 0.0f, 1.0f);
      const std::size_t i = static_cast<std::size_t>(y) * light.width + x;
      for (int c = 0; c < 3; ++c) {
        picture.channels[c].values[i] = std::isnan(v) ? kNoData[c] : share;
      }
    }
  }
  return picture;
}

}  // namespace obscura::tools
