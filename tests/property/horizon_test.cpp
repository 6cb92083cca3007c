// Properties of horizon-based ambient obscurance.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "obscura/obscura.h"
#include "tests/property/reference_scenes.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

using reference_scenes::Scene;
using reference_scenes::Vec;

constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<float> visibility(const synthetic::Input& in, const MethodSettings& settings,
                              int threads = 0) {
  const DepthField field = in.field();
  const int w = field.visible().width, h = field.visible().height;
  std::vector<float> v(static_cast<std::size_t>(w) * h, -1.0f);
  Outputs outputs;
  outputs.visibility = {v.data(), w, h};
  RunOptions options;
  const auto executor = make_executor(threads);
  options.executor = executor.get();
  const Status s = compute(field, settings, outputs, options);
  EXPECT_TRUE(s.ok()) << s.message();
  return v;
}

HorizonSettings dense() {
  HorizonSettings s{.occluder = Occluder::solid()};
  s.directions = 32;
  s.steps = 64;
  s.interleave = 1;
  s.blur = false;
  s.angle_bias = 0;
  return s;
}

double mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

// An upright V with this opening, its edge on the middle column of texel centres.
Scene groove(double degrees) {
  const double half = degrees / 2 * std::numbers::pi / 180;
  const GuardBand guard = GuardBand::symmetric(12, 10);
  const Camera camera = Camera::perspective(0.9f, 97, 71, guard);
  const Vec right{-std::cos(half), 0, std::sin(half)}, left{std::cos(half), 0, std::sin(half)};
  const double offset = -3 * std::sin(half);
  return reference_scenes::room(121, 91, camera, guard, {right, left}, {offset, offset});
}

// Not where a plane ends at infinity: the last texel before the background stands a pixel wide
// there, and the blur carries on what it hides.
float least_away_from_background(const synthetic::Input& in, const std::vector<float>& v) {
  constexpr int kReach = 4;
  float least = 1;
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      bool surface = true;
      for (int b = std::max(y - kReach, 0); b <= std::min(y + kReach, in.height - 1); ++b) {
        for (int a = std::max(x - kReach, 0); a <= std::min(x + kReach, in.width - 1); ++a) {
          surface &= std::isfinite(in.depth[b * in.width + a]);
        }
      }
      if (surface) least = std::min(least, v[y * in.width + x]);
    }
  }
  return least;
}

TEST(Horizon, PlanesAreOpenAtAnyTilt) {
  Random random(1);
  for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    for (int i = 0; i < 14; ++i) {
      Camera camera = Camera::perspective(1.0f, 90, 60);
      if (i % 2) camera = Camera::orthographic_height(4, 90, 60);
      const double tilt = 0.1 * i, turn = 6.28 * random.uniform();
      const synthetic::Input in =
          synthetic::plane(90, 60, camera, std::sin(tilt) * std::cos(turn),
                           std::sin(tilt) * std::sin(turn), std::cos(tilt), 5);
      for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
        HorizonSettings s{.occluder = Occluder::solid()};
        s.variant = variant;
        s.falloff = {.kind = kind, .radius = 10};
        s.angle_bias = 0;
        const std::vector<float> v = visibility(in, s);
        EXPECT_GT(least_away_from_background(in, v), 0.998f) << tilt << " " << i;
      }
    }
  }
}

// Cosine-weighted, the walls being the polygons that the image holds.
TEST(Horizon, SlicesAgreeWithTheClosedFormOfGrooves) {
  for (double degrees : {60, 90, 120, 150}) {
    const Scene scene = groove(degrees);
    for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
      HorizonSettings s = dense();
      s.falloff = {.kind = kind, .radius = kInf};
      const std::vector<float> v = visibility(scene.input, s);
      double sum = 0;
      int count = 0;
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (std::isnan(scene.truth[i])) continue;
        sum += std::abs(v[i] - scene.truth[i]);
        ++count;
      }
      EXPECT_LT(sum / count, 0.01) << degrees;
    }
  }
}

// Uniform weights: a groove of opening phi leaves phi / pi of the hemisphere of the solid angle, as
// far as its walls reach; the attenuation is 1 beside a radius that is far longer than the scene.
TEST(Horizon, ClassicAgreesWithTheSolidAngleOfGrooves) {
  for (double degrees : {90, 120, 150}) {
    const Scene scene = groove(degrees);
    HorizonSettings s = dense();
    s.variant = HorizonVariant::kClassic;
    s.falloff.radius = 100;
    const std::vector<float> v = visibility(scene.input, s);
    // The pixel beside the edge sees the opposite wall as if it had no end.
    EXPECT_NEAR(v[35 * 97 + 50], degrees / 180, 0.03) << degrees;
  }
}

// Two independent ways: the reference traces rays through the same depth field.
TEST(Horizon, SlicesAgreeWithRaysThroughTheDepthField) {
  const synthetic::Input in = synthetic::blocks(96, 64, Camera::perspective(1.0f, 96, 64), 4);
  for (const auto& [kind, radius, limit] : {std::tuple{FalloffKind::kConstant, 0.5f, 0.02},
                                            {FalloffKind::kConstant, kInf, 0.02},
                                            {FalloffKind::kExponential, 0.3f, 0.02},
                                            {FalloffKind::kQuadratic, 1.0f, 0.02}}) {
    ReferenceSettings truth{.occluder = Occluder::solid()};
    truth.falloff = {.kind = kind, .radius = radius};
    HorizonSettings s = dense();
    s.falloff = truth.falloff;
    EXPECT_LT(mean_difference(visibility(in, s), visibility(in, truth)), limit)
        << enum_name(kind) << " " << radius;
  }
}

// A plate in front of a wall, farther away than the radius. The published method ignores it; a
// solid depth image fills the sphere behind it with matter.
TEST(Horizon, FarMatterIsCutAtTheRadiusOrDropped) {
  synthetic::Input in =
      synthetic::plane(160, 120, Camera::perspective(1.0f, 160, 120), 0, 0, 1, 10);
  in.normals.clear();
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 80; ++x) in.depth[y * 160 + x] = 5;
  }
  HorizonSettings s = dense();
  s.falloff = {.kind = FalloffKind::kConstant, .radius = 1};
  const std::size_t beside = 60 * 160 + 81;
  // A wall x = 1.5 pixels away fills the azimuths |phi| < m = acos x, and there the zenith angles
  // beyond asin(x / cos phi): 1/(2 pi) integral of 1 - (x / cos phi)^2 = (m - x^2 tan m) / pi.
  const double x = 1.5 * in.camera.scale_x * 10, m = std::acos(x);
  EXPECT_NEAR(visibility(in, s)[beside], 1 - (m - x * x * std::tan(m)) / std::numbers::pi, 0.03);
  s.variant = HorizonVariant::kClassic;
  EXPECT_NEAR(visibility(in, s)[beside], 1, 1e-3);
}

// The difference is the cost of single texels instead of interpolated ones.
TEST(Horizon, MoreSamplesComeCloserToTheTruth) {
  const synthetic::Input in = synthetic::blocks(96, 64, Camera::perspective(1.0f, 96, 64), 8);
  ReferenceSettings truth{.occluder = Occluder::solid()};
  truth.falloff.radius = 0.3f;
  const std::vector<float> expected = visibility(in, truth);
  double before = 1;
  for (int n : {4, 8, 16}) {
    HorizonSettings s = dense();
    s.falloff.radius = 0.3f;
    s.directions = s.steps = n;
    const double error = mean_difference(visibility(in, s), expected);
    EXPECT_LT(error, before) << n;
    before = error;
  }
}

TEST(Horizon, BitsDoNotDependOnThreads) {
  const synthetic::Input in = synthetic::blocks(130, 90, Camera::perspective(1.2f, 130, 90), 7);
  for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    HorizonSettings s{.occluder = Occluder::solid()};
    s.variant = variant;
    const std::vector<float> one = visibility(in, s, 1), three = visibility(in, s, 3);
    EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(float)), 0);
  }
}

TEST(Horizon, ExtremesHaveDefinedValues) {
  for (const auto& [w, h] : {std::pair{1, 1}, {40, 1}, {1, 40}, {33, 17}}) {
    for (float fov : {0.087f, 2.62f}) {
      for (double scale : {1e-3, 1.0, 1e6}) {
        synthetic::Input in = synthetic::blocks(w, h, Camera::perspective(fov, w, h), 5);
        for (std::size_t i = 0; i < in.depth.size(); ++i) {
          in.depth[i] *= static_cast<float>(i % 7 == 0 ? 1e-3 : scale);
        }
        for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
          for (float radius : {1e-6f, 1.0f, 1e6f}) {
            for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
              HorizonSettings s{.occluder = Occluder::solid()};
              s.variant = variant;
              s.falloff = {.kind = kind, .radius = radius};
              for (float v : visibility(in, s)) EXPECT_TRUE(v >= 0 && v <= 1);
            }
          }
        }
      }
    }
  }
}

TEST(Horizon, BackgroundIsOpenAndDoesNotOcclude) {
  synthetic::Input in = synthetic::plane(80, 60, Camera::perspective(1.0f, 80, 60), 0, 0, 1, 10);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      if (x < 20 || x >= 60 || y < 10) in.depth[y * 80 + x] = kInf;
    }
  }
  for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    HorizonSettings s{.occluder = Occluder::solid()};
    s.variant = variant;
    s.falloff.radius = 10;
    const std::vector<float> v = visibility(in, s);
    EXPECT_GT(*std::min_element(v.begin(), v.end()), 0.999f);
  }
}

struct Directions {
  std::vector<float> visibility, angle, bent, uniform, cosine, normal;
  double dot(const std::vector<float>& a, const std::vector<float>& b, std::size_t i) const {
    return double(a[3 * i]) * b[3 * i] + double(a[3 * i + 1]) * b[3 * i + 1] +
           double(a[3 * i + 2]) * b[3 * i + 2];
  }
};
Directions directions(const synthetic::Input& in, const MethodSettings& settings,
                      bool cosine = true) {
  const std::size_t n = in.depth.size();
  Directions r;
  for (auto* v : {&r.visibility, &r.angle}) v->assign(n, -9);
  for (auto* v : {&r.bent, &r.uniform, &r.cosine, &r.normal}) v->assign(3 * n, -9);
  auto vector = [&](std::vector<float>& v) {
    return VectorView<float>::interleaved(v.data(), in.width, in.height);
  };
  Outputs o;
  o.visibility = {r.visibility.data(), in.width, in.height};
  o.cone_angle = {r.angle.data(), in.width, in.height};
  o.bent_normal = vector(r.bent);
  o.uniform_integral = vector(r.uniform);
  if (cosine) o.cosine_integral = vector(r.cosine);
  o.normal = vector(r.normal);
  const Status s = compute(in.field(), settings, o);
  EXPECT_TRUE(s.ok()) << s.message();
  return r;
}

double mean_degrees(const Directions& a, const Directions& b) {
  double sum = 0;
  const std::size_t n = a.visibility.size();
  for (std::size_t i = 0; i < n; ++i) {
    sum += std::acos(std::clamp(a.dot(a.bent, b.bent, i), -1.0, 1.0));
  }
  return sum / static_cast<double>(n) * 180 / std::numbers::pi;
}

TEST(HorizonDirections, OpenPlanesLookAlongTheirNormals) {
  for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    for (bool orthographic : {false, true}) {
      const Camera camera =
          orthographic ? Camera::orthographic_height(4, 90, 70) : Camera::perspective(1, 90, 70);
      const synthetic::Input in = synthetic::plane(90, 70, camera, 0.48, 0.36, 0.8, 10);
      HorizonSettings s{.occluder = Occluder::solid()};
      s.variant = variant;
      const Directions r = directions(in, s, variant == HorizonVariant::kSlices);
      for (std::size_t i = 0; i < in.depth.size(); ++i) {
        EXPECT_GT(r.dot(r.bent, r.normal, i), 0.9999);
        EXPECT_GT(r.angle[i], 1.52f);
        EXPECT_NEAR(r.dot(r.uniform, r.normal, i), 1, 0.003);
        if (variant == HorizonVariant::kSlices) {
          EXPECT_NEAR(r.dot(r.cosine, r.normal, i), 2.0 / 3, 0.003);
        }
      }
    }
  }
}

TEST(HorizonDirections, UniformIntegralCarriesTheVisibility) {
  const synthetic::Input in = synthetic::blocks(120, 80, Camera::perspective(1, 120, 80), 3);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
    HorizonSettings s{.occluder = Occluder::solid()};
    s.falloff = {.kind = kind, .radius = 0.5f};
    const Directions r = directions(in, s);
    EXPECT_LT(mean_difference(visibility(in, s), r.visibility), 1e-5);
    for (std::size_t i = 0; i < in.depth.size(); ++i) {
      if (!std::isfinite(in.depth[i])) continue;
      ASSERT_NEAR(r.dot(r.normal, r.uniform, i), r.visibility[i], 2e-3);
    }
  }
}

// Two independent ways: rays of the reference carry the same three quantities.
TEST(HorizonDirections, SlicesAgreeWithRaysThroughTheDepthField) {
  const synthetic::Input in = synthetic::blocks(96, 64, Camera::perspective(1.0f, 96, 64), 4);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
    ReferenceSettings truth{.occluder = Occluder::solid()};
    truth.falloff = {.kind = kind, .radius = 0.5f};
    HorizonSettings s = dense();
    s.falloff = truth.falloff;
    const Directions a = directions(in, s), b = directions(in, truth);
    EXPECT_LT(mean_degrees(a, b), 3) << enum_name(kind);
    EXPECT_LT(mean_difference(a.angle, b.angle), 0.04) << enum_name(kind);
    EXPECT_LT(mean_difference(a.uniform, b.uniform), 0.02) << enum_name(kind);
    EXPECT_LT(mean_difference(a.cosine, b.cosine), 0.015) << enum_name(kind);
  }
}

// A wall of endless height beside a floor seen from above: next to it half the hemisphere is
// blocked, and the mean direction of the other half, a quarter sphere, is (1/2, 0, 1/2).
TEST(HorizonDirections, BesideAWallHalfIsOpen) {
  synthetic::Input in =
      synthetic::plane(64, 64, Camera::orthographic_height(2, 64, 64), 0, 0, 1, 50);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) in.depth[y * 64 + x] = 49.5f;
  }
  HorizonSettings s = dense();
  s.variant = HorizonVariant::kClassic;
  s.falloff.radius = 20;
  const Directions r = directions(in, s, false);
  const std::size_t i = 32 * 64 + 32;
  const double length = std::sqrt(0.5);
  EXPECT_NEAR(r.visibility[i], 0.5, 0.03);
  EXPECT_NEAR(r.bent[3 * i], 0.5 / length, 0.05);
  EXPECT_NEAR(r.bent[3 * i + 1], 0, 0.02);
  EXPECT_NEAR(r.angle[i], std::acos(2 * length - 1), 0.1);
}

TEST(Horizon, RefusesWrongSettings) {
  auto refused = [](auto change) {
    HorizonSettings s{.occluder = Occluder::solid()};
    change(s);
    Estimator e;
    return !Estimator::create(s, 8, 8, &e).ok();
  };
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto& s) { s.directions = 1; }));
  EXPECT_TRUE(refused([](auto& s) { s.steps = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.interleave = 9; }));
  EXPECT_TRUE(refused([](auto& s) { s.angle_bias = -1; }));
  EXPECT_TRUE(refused([](auto& s) { s.falloff.radius = 0; }));
  EXPECT_TRUE(refused([](auto& s) {
    s.variant = HorizonVariant::kClassic;
    s.falloff.radius = kInf;
  }));
}

}  // namespace
}  // namespace obscura
