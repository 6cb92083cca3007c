#include "obscura/cone.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace obscura {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

struct Moments {
  double open = 0;              // integral of V
  std::array<double, 3> sum{};  // integral of V w
  double cosine = 0;            // integral of V (n.w)
  std::array<double, 3> cosine_sum{};
};

double length(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

// Integrates a cap of half-angle `alpha` whose axis is tilted by `tilt` from the normal (0, 0, 1),
// by the midpoint rule in the hemisphere's own polar coordinates, which know nothing of the cap.
Moments cap_moments(double alpha, double tilt) {
  Moments m;
  const int rings = 1500, sectors = 3000;
  for (int i = 0; i < rings; ++i) {
    const double cos_theta = (i + 0.5) / rings, sin_theta = std::sqrt(1 - cos_theta * cos_theta);
    for (int j = 0; j < sectors; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / sectors;
      const std::array<double, 3> w = {sin_theta * std::cos(phi), sin_theta * std::sin(phi),
                                       cos_theta};
      if (w[0] * std::sin(tilt) + w[2] * std::cos(tilt) < std::cos(alpha)) continue;
      m.open += 1;
      m.cosine += w[2];
      for (int k = 0; k < 3; ++k) m.sum[k] += w[k], m.cosine_sum[k] += w[k] * w[2];
    }
  }
  const double weight = 2 * kPi / (double(rings) * sectors);
  m.open *= weight, m.cosine *= weight;
  for (int k = 0; k < 3; ++k) m.sum[k] *= weight, m.cosine_sum[k] *= weight;
  return m;
}

TEST(Cone, ExactEstimateFindsTheCap) {
  for (double alpha : {5.0, 20.0, 45.0, 60.0, 90.0}) {
    for (double tilt : {0.0, 15.0, 30.0}) {
      if (alpha + tilt > 90) continue;  // cut by the horizon
      const Moments m = cap_moments(alpha * kDegree, tilt * kDegree);
      const auto mean = static_cast<float>(length(m.sum) / m.open);
      EXPECT_NEAR(cone_angle(ConeEstimate::kExact, mean) / kDegree, alpha, 0.5) << tilt;
      EXPECT_NEAR(std::atan2(m.sum[0], m.sum[2]) / kDegree, tilt, 0.1) << alpha;
    }
  }
}

TEST(Cone, PapersEstimateIsNarrowerThanTheCap) {
  const Moments m = cap_moments(60 * kDegree, 0);
  const auto mean = static_cast<float>(length(m.sum) / m.open);
  EXPECT_NEAR(cone_angle(ConeEstimate::kPaper, mean) / kDegree, 45, 0.5);
  EXPECT_NEAR(cone_angle(ConeEstimate::kPaper, 0.5f) / kDegree, 90, 1e-4);
}

TEST(Cone, LengthsOutOfRangeGiveTheNearestCone) {
  for (ConeEstimate e : {ConeEstimate::kExact, ConeEstimate::kPaper}) {
    EXPECT_FLOAT_EQ(cone_angle(e, 0), kPi / 2);
    EXPECT_FLOAT_EQ(cone_angle(e, 0.3f), kPi / 2);
    EXPECT_EQ(cone_angle(e, 1), 0);
    EXPECT_EQ(cone_angle(e, 1.00001f), 0);
  }
  EXPECT_EQ(cone_cosine_of_cosine_mean(0), 0);
  EXPECT_EQ(cone_cosine_of_cosine_mean(0.5f), 0);
  EXPECT_EQ(cone_cosine_of_cosine_mean(1), 1);
  EXPECT_EQ(cone_cosine_of_cosine_mean(1.5f), 1);
}

TEST(Cone, UniformIntegralIsTwiceAmbientOcclusionTimesTheMean) {
  for (double alpha : {30.0, 60.0, 90.0}) {
    const Moments m = cap_moments(alpha * kDegree, 0);
    const auto ao = static_cast<float>(m.open / (2 * kPi));
    const auto mean = static_cast<float>(length(m.sum) / m.open);
    const auto integral = static_cast<float>(length(m.sum) / kPi);
    EXPECT_NEAR(uniform_integral_factor(ao) * mean, integral, 1e-6);
    EXPECT_NEAR(mean_length_of_uniform_integral(integral, ao), mean, 1e-6);
  }
  EXPECT_EQ(mean_length_of_uniform_integral(0, 0), 1);
}

TEST(Cone, BentConesAreTheMeanAndItsAngle) {
  const Moments m = cap_moments(40 * kDegree, 30 * kDegree);
  std::array<float, 3> integral{};
  for (int k = 0; k < 3; ++k) integral[k] = static_cast<float>(m.sum[k] / kPi);
  const auto ao = static_cast<float>(m.open / (2 * kPi));
  const BentCone cone = bent_cone(ConeEstimate::kExact, integral, ao, {0, 0, 1});
  EXPECT_NEAR(std::atan2(cone.direction[0], cone.direction[2]) / kDegree, 30, 0.1);
  EXPECT_NEAR(cone.angle / kDegree, 40, 0.5);
}

TEST(Cone, ClosedPointsHaveTheirNormalAndNoOpening) {
  const std::array<float, 3> normal{0.6f, 0, 0.8f};
  for (ConeEstimate e : {ConeEstimate::kExact, ConeEstimate::kPaper}) {
    // Nothing visible, next to nothing, and numbers of which one says that nothing is.
    for (const auto& [x, ao] : {std::pair{0.0f, 0.0f}, {5e-4f, 2.5e-4f}, {0.3f, 0.0f}}) {
      const BentCone cone = bent_cone(e, {x, 0, 0}, ao, normal);
      EXPECT_EQ(cone.direction, normal) << x;
      EXPECT_EQ(cone.angle, 0) << x;
    }
    EXPECT_EQ(cone_angle(e, mean_length_of_uniform_integral(0, 0)), 0);
    EXPECT_NEAR(bent_cone(e, {0, 0, 1}, 1, normal).angle, kPi / 2, 1e-6);
  }
}

TEST(Cone, CosineWeightedMeansHaveTheirOwnInverse) {
  for (double alpha : {10.0, 40.0, 60.0, 90.0}) {
    const Moments m = cap_moments(alpha * kDegree, 0);
    const auto mean = static_cast<float>(length(m.cosine_sum) / m.cosine);
    EXPECT_NEAR(std::acos(cone_cosine_of_cosine_mean(mean)) / kDegree, alpha, 0.5);
  }
}

// Why the two means are not to be mixed: a cap of 60 degrees tilted by 30.
TEST(Cone, MeansOfATiltedCapPointApart) {
  const Moments m = cap_moments(60 * kDegree, 30 * kDegree);
  const double uniform = std::atan2(m.sum[0], m.sum[2]);
  const double cosine = std::atan2(m.cosine_sum[0], m.cosine_sum[2]);
  EXPECT_NEAR((uniform - cosine) / kDegree, 11.7, 0.1);
}

}  // namespace
}  // namespace obscura
