#ifndef OBSCURA_TESTS_UNIT_LIGHTING_ENVIRONMENTS_H_
#define OBSCURA_TESTS_UNIT_LIGHTING_ENVIRONMENTS_H_

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "obscura/environment.h"

namespace obscura {

using Direction = std::array<float, 3>;

inline Direction unit(double x, double y, double z) {
  const double s = 1 / std::sqrt(x * x + y * y + z * z);
  return {float(x * s), float(y * s), float(z * s)};
}

// A latitude-longitude map from a function of direction.
template <class Radiance>
std::vector<float> lat_long(int width, int height, const Radiance& radiance) {
  std::vector<float> pixels(std::size_t(width) * height * 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double theta = std::numbers::pi * (y + 0.5) / height;
      const double phi = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
      const Direction d{float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)),
                        float(-std::sin(theta) * std::cos(phi))};
      const Direction rgb = radiance(d);
      for (int c = 0; c < 3; ++c) pixels[(std::size_t(y) * width + x) * 3 + c] = rgb[c];
    }
  }
  return pixels;
}

template <class Radiance>
Environment make_environment(const Radiance& radiance, int width = 256) {
  std::vector<float> pixels = lat_long(width, width / 2, radiance);
  Environment environment;
  const Status s = Environment::from_lat_long(
      VectorView<float>::interleaved(pixels.data(), width, width / 2), &environment);
  EXPECT_TRUE(s.ok()) << s.message();
  return environment;
}

// Directions spread over the sphere, among them cube edges, corners and face centres.
inline std::vector<Direction> directions() {
  std::vector<Direction> all;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x || y || z) all.push_back(unit(x, y, z));
      }
    }
  }
  for (int k = 0; k < 100; ++k) {
    const double z = 1 - (k + 0.5) / 50, r = std::sqrt(1 - z * z), phi = 2.39996323 * k;
    all.push_back(unit(r * std::cos(phi), r * std::sin(phi), z));
  }
  return all;
}

}  // namespace obscura

#endif  // OBSCURA_TESTS_UNIT_LIGHTING_ENVIRONMENTS_H_
