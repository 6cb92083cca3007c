#include <gtest/gtest.h>

#include <array>

#include "obscura/estimator.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

struct Result {
  std::vector<float> visibility, bent[3], cone;
};
Result run(const DepthField& field, const MethodSettings& settings, bool directions) {
  const int w = field.visible().width, h = field.visible().height;
  Result r;
  auto make = [&](std::vector<float>& v) -> ImageView<float> {
    v.assign(std::size_t(w) * h, -9.0f);
    return {v.data(), w, h};
  };
  Outputs outputs{.visibility = make(r.visibility)};
  if (directions) {
    outputs.bent_normal = {make(r.bent[0]), make(r.bent[1]), make(r.bent[2])};
    outputs.cone_angle = make(r.cone);
  }
  const Status status = compute(field, settings, outputs);
  EXPECT_TRUE(status.ok()) << status.message();
  return r;
}

HorizonSettings horizon(Resolution resolution) {
  HorizonSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = 1;
  s.resolution = resolution;
  return s;
}

// The image that the method gets, made in another way: every second pixel, and a camera with these
// pixel centres.
TEST(HalfResolution, TheSeenPixelsAreThoseOfAnImageOfEverySecond) {
  Random random(3);
  for (int i = 0; i < 8; ++i) {
    const int left = i % 2, top = i / 2 % 2, w = 41 + i / 4, h = 30 - i / 4;
    synthetic::Input in =
        synthetic::blocks(w, h, synthetic::random_camera(w, h, i % 3 == 0, &random), i);
    in.guard_band = {.left = left, .right = 2, .top = top, .bottom = 1};
    const DepthField field = in.field();
    const int half_w = (w - left + 1) / 2, half_h = (h - top + 1) / 2;
    synthetic::Input every{half_w, half_h, {}, {}, in.camera, {}};
    every.camera.scale_x *= 2;
    every.camera.scale_y *= 2;
    // The centre of the first seen pixel, left + 1/2, is at 1/2.
    every.camera.center_u = (in.camera.center_u - left - 0.5f) / 2 + 0.5f;
    every.camera.center_v = (in.camera.center_v - top - 0.5f) / 2 + 0.5f;
    every.guard_band.right = half_w - (field.visible().width + 1) / 2;
    every.guard_band.bottom = half_h - (field.visible().height + 1) / 2;
    const int vw = field.visible().width, vh = field.visible().height;
    std::array<std::vector<float>, 3> n;
    for (auto& axis : n) axis.assign(std::size_t(vw) * vh, 0.0f);
    ASSERT_TRUE(
        compute(field, horizon(Resolution::kFull),
                {.normal = {{n[0].data(), vw, vh}, {n[1].data(), vw, vh}, {n[2].data(), vw, vh}}})
            .ok());
    for (int y = 0; y < half_h; ++y) {
      for (int x = 0; x < half_w; ++x) {
        every.depth.push_back(in.depth[std::size_t(top + 2 * y) * w + left + 2 * x]);
        for (const auto& axis : n) {
          const bool visible = 2 * x < vw && 2 * y < vh;
          every.normals.push_back(visible ? axis[std::size_t(2 * y) * vw + 2 * x] : 0.0f);
        }
      }
    }
    const Result half = run(field, horizon(Resolution::kHalf), true);
    const Result expected = run(every.field(), horizon(Resolution::kFull), true);
    const int ew = every.visible().width;
    for (int y = 0; y < every.visible().height; ++y) {
      for (int x = 0; x < ew; ++x) {
        const std::size_t a = std::size_t(2 * y) * vw + 2 * x, b = std::size_t(y) * ew + x;
        EXPECT_NEAR(half.visibility[a], expected.visibility[b], 2e-3) << x << " " << y;
        EXPECT_NEAR(half.cone[a], expected.cone[b], 2e-2) << x << " " << y;
      }
    }
  }
}

TEST(HalfResolution, PlanesStayOpenAndTheirBentNormalsAreTheNormal) {
  for (bool orthographic : {false, true}) {
    const Camera camera =
        orthographic ? Camera::orthographic_height(4, 50, 37) : Camera::perspective(1, 50, 37);
    const synthetic::Input in = synthetic::plane(50, 37, camera, 0.3, 0.4, std::sqrt(0.75), 9);
    const Result r = run(in.field(), horizon(Resolution::kHalf), true);
    for (std::size_t i = 0; i < in.depth.size(); ++i) {
      if (in.depth[i] == kInf) continue;
      EXPECT_NEAR(r.visibility[i], 1, 2e-3);
      EXPECT_NEAR(r.bent[0][i], 0.3, 2e-3);
      EXPECT_NEAR(r.bent[1][i], 0.4, 2e-3);
    }
  }
}

// A wall with a board in front of it: a pixel between two computed ones takes the value of its own
// surface.
TEST(HalfResolution, NothingCrossesAnEdge) {
  const int w = 60, h = 40;
  synthetic::Input in = synthetic::plane(w, h, Camera::perspective(1, w, h), 0, 0, 1, 6);
  in.normals.clear();
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x <= 30; ++x) in.depth[std::size_t(y) * w + x] = 5;
  }
  HorizonSettings s = horizon(Resolution::kHalf);
  s.interleave = 1;
  const Result r = run(in.field(), s, false);
  for (int y = 4; y < h - 4; ++y) {
    // Computed pixels: 28, 30 on the board and 32, 34 on the wall, which the board darkens.
    const float* row = r.visibility.data() + std::size_t(y) * w;
    EXPECT_GT(row[30], row[32] + 0.1f);
    EXPECT_NEAR(row[29], 0.5f * (row[28] + row[30]), 1e-5f);
    EXPECT_EQ(row[31], row[32]);
    EXPECT_NEAR(row[33], 0.5f * (row[32] + row[34]), 1e-5f);
  }
}

TEST(HalfResolution, WhatNoSeenPixelLiesBesideIsOpen) {
  const int w = 9, h = 9;
  synthetic::Input in = synthetic::plane(w, h, Camera::perspective(1, w, h), 0, 0, 1, 6);
  in.normals.clear();
  in.depth.assign(in.depth.size(), kInf);
  in.depth[3 * w + 5] = 4;
  const Result r = run(in.field(), horizon(Resolution::kHalf), true);
  EXPECT_EQ(r.visibility[3 * w + 5], 1);
  EXPECT_EQ(r.bent[2][3 * w + 5], 1);
  EXPECT_NEAR(r.cone[3 * w + 5], 1.5707963f, 1e-6f);
}

// Every method, odd sizes and guard bands: close to the result at full resolution.
TEST(HalfResolution, EveryMethodIsNearItself) {
  for (const auto& size : {std::pair{1, 1}, {2, 3}, {97, 64}}) {
    const int w = size.first, h = size.second;
    for (bool orthographic : {false, true}) {
      Random random(7);
      synthetic::Input in = synthetic::blocks(
          w, h, orthographic ? Camera::orthographic_height(6, w, h) : Camera::perspective(1, w, h),
          5);
      if (w > 3) in.guard_band = {.left = 3, .right = 0, .top = 1, .bottom = 2};
      const auto expect = [&](auto settings, const char* name) {
        settings.falloff.radius = 1;
        const Result full = run(in.field(), settings, false);
        settings.resolution = Resolution::kHalf;
        const Result half = run(in.field(), settings, false);
        double sum = 0;
        for (std::size_t i = 0; i < full.visibility.size(); ++i) {
          EXPECT_GE(half.visibility[i], 0) << name;
          EXPECT_LE(half.visibility[i], 1) << name;
          sum += std::abs(full.visibility[i] - half.visibility[i]);
        }
        if (w <= 3) return;
        EXPECT_LT(sum / full.visibility.size(), 0.05) << name << orthographic;
      };
      expect(AreaSettings{}, "area");
      expect(FarFieldSettings{}, "far-field");
      expect(HemisphereSettings{}, "hemisphere");
      expect(HorizonSettings{}, "horizon");
      expect(LineSettings{}, "line");
      expect(MipmapSettings{}, "mipmap");
      expect(PointSettings{}, "point");
    }
  }
}

}  // namespace
}  // namespace obscura
