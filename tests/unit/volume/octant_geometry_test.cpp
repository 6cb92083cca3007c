#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "volume/transport.h"

namespace obscura {
namespace {

std::array<float, 3> unit(double x, double y, double z) {
  const double l = std::hypot(x, y, z);
  return {float(x / l), float(y / l), float(z / l)};
}

TEST(OctantGeometry, EightSumToPiAndAWholeOctantIsTheClosedForm) {
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const auto n = unit(normal(rng), normal(rng), normal(rng));
    double sum = 0;
    for (int s = 0; s < 8; ++s) sum += octant_geometry(n, s);
    EXPECT_NEAR(sum, std::numbers::pi, 1e-5);
  }
  const auto n = unit(1, 2, 3);
  // Wholly above the horizon: N . (pi/4, pi/4, pi/4).
  EXPECT_NEAR(octant_geometry(n, 7), std::numbers::pi / 4 * (n[0] + n[1] + n[2]), 1e-6);
  EXPECT_EQ(octant_geometry(n, 0), 0);
  EXPECT_NEAR(octant_geometry({0, 0, 1}, 5), std::numbers::pi / 4, 1e-6);
}

TEST(OctantGeometry, AgreesWithQuadrature) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(0, 1);
  const auto n = unit(0.6, -0.5, 0.3);
  double sums[8] = {};
  constexpr int kSamples = 400000;
  for (int i = 0; i < kSamples; ++i) {
    const double z = 2 * u(rng) - 1, a = 2 * std::numbers::pi * u(rng), r = std::sqrt(1 - z * z);
    const double w[3] = {r * std::cos(a), r * std::sin(a), z};
    const int octant = (w[0] > 0) | (w[1] > 0) << 1 | (w[2] > 0) << 2;
    sums[octant] += std::max(0.0, w[0] * n[0] + w[1] * n[1] + w[2] * n[2]);
  }
  for (int s = 0; s < 8; ++s) {
    EXPECT_NEAR(octant_geometry(n, s), sums[s] * 4 * std::numbers::pi / kSamples, 6e-3);
  }
}

}  // namespace
}  // namespace obscura
