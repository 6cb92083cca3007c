// The frame of a slice around a tilted ray against vectors in double. Compiled once per SIMD
// target.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/unit/math/azimuth_test.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

#ifndef OBSCURA_TESTS_UNIT_MATH_AZIMUTH_TEST_ONCE
#define OBSCURA_TESTS_UNIT_MATH_AZIMUTH_TEST_ONCE
namespace obscura {

struct FrameCase {
  float a, b;            // the ray is (a, b, 1)
  float step_u, step_v;  // an image direction
  float low_u, low_v, high_u, high_v;
  float nu, nv, nw;
};
struct FrameResult {
  float along_ray, lateral, nz, nt, width;
};

}  // namespace obscura
#endif

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

FrameResult FrameOf(const FrameCase& c) {
  namespace hn = hwy::HWY_NAMESPACE;
  using leaf::real;
  const leaf::ViewRay ray = leaf::make_ray(real(c.a), real(c.b));
  const leaf::Azimuth s =
      leaf::make_azimuth(ray, real(c.step_u), real(c.step_v), real(c.nu), real(c.nv), real(c.nw));
  const leaf::Real width =
      leaf::azimuth_between(ray, real(c.low_u), real(c.low_v), real(c.high_u), real(c.high_v));
  return {hn::GetLane(s.along), hn::GetLane(s.across), hn::GetLane(s.nz), hn::GetLane(s.nt),
          hn::GetLane(width)};
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
namespace {

HWY_EXPORT(FrameOf);

FrameResult frame_of(const FrameCase& c) { return HWY_DYNAMIC_DISPATCH(FrameOf)(c); }

constexpr double kPi = std::numbers::pi;

FrameCase random_case(Random& random) {
  auto signed_uniform = [&] { return 2 * random.uniform() - 1; };
  const double angle = 2 * kPi * random.uniform(), nu = signed_uniform(), nv = signed_uniform(),
               nw = signed_uniform(), length = std::sqrt(nu * nu + nv * nv + nw * nw);
  FrameCase c{};
  c.a = static_cast<float>(3 * signed_uniform());
  c.b = static_cast<float>(3 * signed_uniform());
  c.step_u = static_cast<float>(0.002 * std::cos(angle));
  c.step_v = static_cast<float>(0.003 * std::sin(angle));
  c.nu = static_cast<float>(nu / length);
  c.nv = static_cast<float>(nv / length);
  c.nw = static_cast<float>(nw / length);
  return c;
}

TEST(Azimuth, FrameIsTheZenithAndTheStepAtRightAnglesToIt) {
  Random random(21);
  for (int i = 0; i < 500; ++i) {
    const FrameCase c = random_case(random);
    const double ray[3] = {c.a, c.b, 1}, step[3] = {c.step_u, c.step_v, 0},
                 normal[3] = {c.nu, c.nv, c.nw};
    auto dot = [](const double* x, const double* y) {
      return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    };
    const double length = std::sqrt(dot(ray, ray));
    double zenith[3], tangent[3];
    for (int k = 0; k < 3; ++k) zenith[k] = -ray[k] / length;
    for (int k = 0; k < 3; ++k) tangent[k] = step[k] - dot(step, zenith) * zenith[k];
    const double lateral = std::sqrt(dot(tangent, tangent));
    for (double& t : tangent) t /= lateral;

    const FrameResult f = frame_of(c);
    EXPECT_NEAR(f.along_ray, -dot(step, zenith), 1e-6 * 0.003);
    EXPECT_NEAR(f.lateral / lateral, 1, 1e-5);
    EXPECT_NEAR(f.nz, dot(normal, zenith), 1e-6);
    EXPECT_NEAR(f.nt, dot(normal, tangent), 2e-5);
  }
}

// Sectors that share their edges go once around every ray, though none has the same share.
TEST(Azimuth, SectorsSumToTheWholeCircleAroundTiltedRays) {
  Random random(22);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (int i = 0; i < 100; ++i) {
      FrameCase c = random_case(random);
      if (i % 4 == 0) c.a = c.b = 0;  // parallel view rays
      const int sectors = 4 + random.below(60);
      double sum = 0, smallest = 10, largest = 0;
      for (int k = 0; k < sectors; ++k) {
        auto edge = [&](int n, float* u, float* v) {
          *u = static_cast<float>(0.002 * std::cos(2 * kPi * n / sectors));
          *v = static_cast<float>(0.002 * std::sin(2 * kPi * n / sectors));
        };
        edge(k, &c.low_u, &c.low_v);
        edge(k + 1, &c.high_u, &c.high_v);
        const double width = frame_of(c).width;
        sum += width;
        smallest = std::min(smallest, width);
        largest = std::max(largest, width);
      }
      EXPECT_NEAR(sum, 2 * kPi, 2e-3) << sectors << " around (" << c.a << ", " << c.b << ", 1)";
      // A tilt by t squeezes azimuths beside it by cos t and stretches those across by as much.
      const double squeeze = std::sqrt(1 + c.a * c.a + c.b * c.b);
      EXPECT_LE(largest, 1.001 * squeeze * squeeze * smallest);
      if (squeeze > 2 && sectors > 8) {
        EXPECT_GT(largest, 1.1 * smallest);
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace obscura
#endif  // HWY_ONCE
