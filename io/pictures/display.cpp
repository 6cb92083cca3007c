#include "io/pictures/display.h"

#include <algorithm>
#include <cmath>

namespace obscura::tools {

Image box_filtered(const Image& image, int n) {
  Image result(image.width / n, image.height / n);
  for (const auto& channel : image.channels) {
    std::vector<float>& to = result.add(channel.name);
    for (int y = 0; y < result.height; ++y) {
      for (int x = 0; x < result.width; ++x) {
        double sum = 0;
        for (int i = 0; i < n * n; ++i) {
          sum += channel.values[std::size_t(y * n + i / n) * image.width + x * n + i % n];
        }
        to[std::size_t(y) * result.width + x] = static_cast<float>(sum / (n * n));
      }
    }
  }
  return result;
}

void to_srgb(double exposure, Image* image) {
  const auto gain = static_cast<float>(std::exp2(exposure));
  for (auto& channel : image->channels) {
    for (float& v : channel.values) {
      const float c = std::min(std::max(v * gain, 0.0f), 1.0f);
      v = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    }
  }
}

}  // namespace obscura::tools
