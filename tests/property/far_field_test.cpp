// Properties of far-field ambient obscurance as users call it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "io/images/files.h"
#include "obscura/obscura.h"
#include "paths.h"
#include "scene/truth/compare.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<float> visibility(const DepthField& field, const FarFieldSettings& settings,
                              int threads = 1) {
  const int w = field.visible().width, h = field.visible().height;
  std::vector<float> result(static_cast<std::size_t>(w) * h, -1.0f);
  Estimator estimator;
  Status s = Estimator::create(settings, field.depth.width, field.depth.height, &estimator);
  EXPECT_TRUE(s.ok()) << s.message();
  s = estimator.run(field, {.visibility = {result.data(), w, h}}, {.threads = threads});
  EXPECT_TRUE(s.ok()) << s.message();
  return result;
}

FarFieldSettings quick() {
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.directions = 8;
  s.near_step = NearStep::of(1);
  return s;
}

bool all_in_range(const std::vector<float>& v) {
  for (float x : v) {
    if (!(x >= 0 && x <= 1)) return false;
  }
  return true;
}

// Regression thresholds: the figures of an independent prototype and ray tracer (section 2 of the
// notes on Timonen 2013).
// Not with sanitizers, where it would take minutes.
TEST(FarField, MeetsTheErrorBarsOnTheDepthImages) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "measured by builds without sanitizers";
#endif
  const std::string folder = OBSCURA_SOURCE_DIR "/../shared/data/depth/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  struct Case {
    const char* image;
    const char* truth;
    float radius;
    double e_a, within_5;
    double fast = 0, balanced = 0;
  };
  for (const Case& c : {Case{"hall", "hall", 2, 0.84, 98.5, 1.3, 0.9},
                        Case{"spheres", "spheres", 1, 0.53, 98.5, 0.9, 0.65},
                        Case{"terrain", "terrain", 0.7f, 1.12, 91, 2.15, 1.6},
                        Case{"hall", "hall.endless", kInf, 0.7, 98.5}}) {
    tools::Image depth, truth;
    ASSERT_TRUE(tools::read_image(folder + c.image + ".pfm", &depth).ok());
    ASSERT_TRUE(tools::read_image(folder + c.truth + ".truth.pfm", &truth).ok());
    DepthField field;
    field.depth = depth.view(0);
    field.guard_band = GuardBand::symmetric(64, 36);
    field.camera = {
        .scale_x = 1 / 311.769f, .scale_y = 1 / 311.769f, .center_u = 384, .center_v = 216};
    FarFieldSettings s{.occluder = Occluder::solid()};
    s.falloff.radius = c.radius;
    auto compare = [&](const FarFieldSettings& settings) {
      const std::vector<float> v = visibility(field, settings, 2);
      tools::Comparison result;
      EXPECT_TRUE(tools::compare({v.data(), 640, 360}, truth.view(0), {}, &result).ok());
      return result;
    };
    const tools::Comparison result = compare(s);
    EXPECT_LE(result.e_a, c.e_a) << c.truth;
    EXPECT_GE(result.within_5, c.within_5) << c.truth;
    if (c.fast > 0) {
      s.preset = FarFieldPreset::kFast;
      EXPECT_LE(compare(s).e_a, c.fast) << c.truth;
      s.preset = FarFieldPreset::kBalanced;
      EXPECT_LE(compare(s).e_a, c.balanced) << c.truth;
      s.preset = FarFieldPreset::kNone;
    }
    if (std::string(c.truth) != "hall") continue;
    s.profile = SlabProfile::kSlab;
    s.receiver_slope = -1;
    s.near_step = NearStep::of(1);
    const tools::Comparison slab = compare(s);
    EXPECT_NEAR(slab.e_a, 2.91, 0.15 * 2.91);
    EXPECT_GT(slab.bias, 0);
    EXPECT_LE(result.e_a, 0.5 * slab.e_a);
  }
}

TEST(FarField, TiltedPlanesAreOpen) {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < 12; ++i) {
    Camera camera = Camera::perspective(1.0f, 120, 90);
    if (i % 2) camera = Camera::orthographic_height(4, 120, 90);
    const double tilt = 0.1 * i, turn = 6.28 * random.uniform();
    const synthetic::Input in =
        synthetic::plane(120, 90, camera, std::sin(tilt) * std::cos(turn),
                         std::sin(tilt) * std::sin(turn), std::cos(tilt), 10);
    FarFieldSettings s = quick();
    s.falloff.radius = kInf;
    const std::vector<float> v = visibility(in.field(), s);
    double sum = 0;
    for (float x : v) sum += x;
    worst = std::max(worst, 1 - sum / v.size());
  }
  // The two receiver slopes meet above a tilted plane's own points.
  EXPECT_LT(worst, 0.01);
}

TEST(FarField, TiltedPlanesOfFiniteMatterAreOpen) {
  for (int i = 0; i < 6; ++i) {
    const double tilt = 0.15 * i;
    const synthetic::Input in =
        synthetic::plane(120, 90, Camera::perspective(1.0f, 120, 90), std::sin(tilt) * 0.8,
                         std::sin(tilt) * 0.6, std::cos(tilt), 10);
    for (float thickness : {0.01f, 0.3f, 1e6f}) {
      FarFieldSettings s = quick();
      s.falloff.radius = kInf;
      s.occluder = Occluder::of_thickness(thickness);
      const std::vector<float> v = visibility(in.field(), s);
      double sum = 0;
      for (float x : v) sum += x;
      EXPECT_GT(sum / v.size(), 0.99) << tilt << " " << thickness;
    }
  }
}

// A thin plate before a wall, both facing the camera: light passes behind the plate.
TEST(FarField, LightPassesBehindThinMatter) {
  synthetic::Input in =
      synthetic::plane(160, 120, Camera::perspective(1.0f, 160, 120), 0, 0, 1, 10);
  in.normals.clear();
  std::vector<float> back(in.depth.size(), 10.1f);
  for (int y = 40; y < 80; ++y) {
    for (int x = 60; x < 100; ++x) {
      in.depth[y * 160 + x] = 5;
      back[y * 160 + x] = 5.1f;
    }
  }
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = kInf;
  const std::size_t beside = 60 * 160 + 55;  // on the wall, five pixels from the plate's outline
  const float solid = visibility(in.field(), s)[beside];
  s.occluder = Occluder::of_thickness(0.1f);
  const float thick = visibility(in.field(), s)[beside];
  s.occluder = Occluder::back_depth();
  DepthField field = in.field();
  field.back_depth = {back.data(), 160, 120};
  const float given = visibility(field, s)[beside];
  // Solid, the plate's matter is a wall on one side; a third is gone.
  EXPECT_LT(solid, 0.7f);
  EXPECT_NEAR(thick, given, 0.01f);
  // The plate, 2.7 wide, floats 5 in front and takes little of the sky.
  EXPECT_GT(given, 0.85f);
}

// Posts of a few pixels in front of a thick wall and of the sky. Wall and post must not be joined,
// although the wall is thicker than the gap, and the rounded sides of a post must not occlude each
// other.
TEST(FarField, FiniteMatterAgreesWithRays) {
  constexpr int kWidth = 96, kHeight = 72;
  synthetic::Input in =
      synthetic::plane(kWidth, kHeight, Camera::perspective(1.0f, kWidth, kHeight), 0, 0, 1, 10);
  std::vector<float> back(in.depth.size(), 12.0f);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t i = std::size_t(y) * kWidth + x;
      if (x >= 60) in.depth[i] = kInf;
      if (x >= 28 && x <= 32) {
        in.depth[i] = 8.0f - 0.1f * (2 - std::abs(x - 30));
        back[i] = 8.3f;
      }
      if (x >= 78 && x <= 82) {
        const float side = 0.45f * (x - 80);  // of the normal, across the post
        in.depth[i] = 9.0f + 0.06f * (x - 80) * (x - 80);
        back[i] = 9.5f;
        in.normals[3 * i] = side;
        in.normals[3 * i + 2] = std::sqrt(1 - side * side);
      }
    }
  }
  DepthField field = in.field();
  field.back_depth = {back.data(), kWidth, kHeight};
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = 1.5f;
  ReferenceSettings rays{.occluder = Occluder::solid()};
  rays.falloff = s.falloff;
  for (const Occluder& occluder : {Occluder::back_depth(), Occluder::of_thickness(0.4f)}) {
    s.occluder = rays.occluder = occluder;
    std::vector<float> truth(in.depth.size());
    ASSERT_TRUE(compute(field, rays, {.visibility = {truth.data(), kWidth, kHeight}}).ok());
    const std::vector<float> v = visibility(field, s);
    double sum[2] = {};
    int count[2] = {};
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (!std::isfinite(in.depth[i])) continue;
      const bool post = int(i % kWidth) >= 78;
      sum[post] += std::abs(v[i] - truth[i]);
      ++count[post];
    }
    EXPECT_LT(sum[0] / count[0], 0.02) << "wall, " << int(occluder.kind);
    EXPECT_LT(sum[1] / count[1], 0.05) << "post, " << int(occluder.kind);
  }
}

TEST(FarField, MirroredInputGivesMirroredOutput) {
  synthetic::Input in = synthetic::blocks(150, 70, Camera::perspective(1.0f, 150, 70), 3);
  const std::vector<float> v = visibility(in.field(), quick());
  for (int y = 0; y < in.height; ++y) {
    std::reverse(in.depth.begin() + y * in.width, in.depth.begin() + (y + 1) * in.width);
  }
  const std::vector<float> m = visibility(in.field(), quick());
  double sum = 0;
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      sum += std::abs(v[y * in.width + x] - m[y * in.width + in.width - 1 - x]);
    }
  }
  // Equal depth steps on both sides of a pixel give its normal to the forward one.
  EXPECT_LT(sum / v.size(), 0.002);
}

TEST(FarField, BitsDoNotDependOnThreads) {
  const synthetic::Input in = synthetic::blocks(130, 90, Camera::perspective(1.2f, 130, 90), 7);
  const std::vector<float> one = visibility(in.field(), quick(), 1);
  const std::vector<float> three = visibility(in.field(), quick(), 3);
  EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(float)), 0);
}

TEST(FarField, ExtremesHaveDefinedValues) {
  for (const auto& [w, h] : {std::pair{1, 1}, {50, 1}, {1, 50}, {33, 17}}) {
    for (float fov : {0.087f, 2.62f}) {
      for (double scale : {1e-3, 1.0, 1e6}) {
        for (SlabProfile profile : {SlabProfile::kSlab, SlabProfile::kAdaptiveChord}) {
          synthetic::Input in = synthetic::blocks(w, h, Camera::perspective(fov, w, h), 5);
          for (std::size_t i = 0; i < in.depth.size(); ++i) {
            in.depth[i] *= static_cast<float>(i % 7 == 0 ? 1e-3 : scale);
          }
          FarFieldSettings s = quick();
          s.profile = profile;
          s.interval = 4;
          EXPECT_TRUE(all_in_range(visibility(in.field(), s))) << w << "x" << h << " " << scale;
          s.occluder = Occluder::of_thickness(static_cast<float>(0.1 * scale));
          EXPECT_TRUE(all_in_range(visibility(in.field(), s))) << w << "x" << h << " " << scale;
        }
      }
    }
  }
}

TEST(FarField, AllBackgroundIsOpen) {
  synthetic::Input in = synthetic::blocks(40, 30, Camera::perspective(1, 40, 30), 1);
  std::fill(in.depth.begin(), in.depth.end(), kInf);
  for (float v : visibility(in.field(), quick())) EXPECT_EQ(v, 1);
}

// A tower in front of the sky: there is no halo beside it.
// Also of work that pixels share: a group has surfaces only.
TEST(FarField, BackgroundBesideSurfacesIsOpen) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 3);
  for (int side : {1, 2, 3}) {
    FarFieldSettings s{.occluder = Occluder::solid()};
    s.directions = side == 3 ? 18 : 8;
    s.separable = side;
    s.jitter = side == 1;
    std::vector<float> v(in.depth.size());
    ASSERT_TRUE(compute(in.field(), s, {.visibility = {v.data(), 64, 48}}).ok());
    int background = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (std::isfinite(in.depth[i])) continue;
      EXPECT_EQ(v[i], 1) << i;
      ++background;
    }
    EXPECT_GT(background, 50);
  }
}

TEST(FarField, BackgroundDoesNotOcclude) {
  synthetic::Input in =
      synthetic::plane(160, 120, Camera::perspective(1.0f, 160, 120), 0, 0, 1, 10);
  in.normals.clear();
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (x < 40 || x >= 120 || y < 20) in.depth[y * 160 + x] = kInf;
    }
  }
  const std::vector<float> v = visibility(in.field(), quick());
  EXPECT_GT(*std::min_element(v.begin(), v.end()), 0.999f);
}

TEST(FarField, EveryFalloffAndEveryWrongSettingIsAnswered) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1.0f, 64, 48), 9);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential,
                           FalloffKind::kQuadratic, FalloffKind::kInverseSquare}) {
    for (float radius : {1e-6f, 0.5f, 1e6f, kInf}) {
      FarFieldSettings s = quick();
      s.falloff = {.kind = kind, .radius = radius};
      EXPECT_TRUE(all_in_range(visibility(in.field(), s)));
    }
  }
  auto refused = [](auto change) {
    FarFieldSettings s{.occluder = Occluder::solid()};
    change(s);
    Estimator e;
    return !Estimator::create(s, 8, 8, &e).ok();
  };
  EXPECT_TRUE(refused([](auto& s) { s.directions = 3; }));
  EXPECT_TRUE(refused([](auto& s) { s.segments = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.interval = 1; }));
  EXPECT_TRUE(refused([](auto& s) { s.receiver_slope = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.near_step = NearStep::of(-1); }));
  EXPECT_TRUE(refused([](auto& s) { s.falloff.radius = -1; }));
}

}  // namespace
}  // namespace obscura
