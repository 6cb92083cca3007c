#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanPoint = VulkanTest;

PointSettings ball(float radius) {
  PointSettings s;
  s.falloff.radius = radius;
  s.blur = false;
  return s;
}

TEST_F(VulkanPoint, BallAgreesForEverySetting) {
  const synthetic::Input in = synthetic::blocks(90, 60, Camera::perspective(1, 90, 60), 3);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kQuadratic}) {
    for (bool rotate : {false, true}) {
      for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.3f)}) {
        for (NormalUse use : {NormalUse::kAuto, NormalUse::kNone}) {
          PointSettings s = ball(0.7f);
          s.falloff.kind = kind;
          s.rotate = rotate;
          s.occluder = occluder;
          DepthField field = in.field();
          field.normal_use = use;
          expect_same(field, s,
                      "kind " + std::to_string(int(kind)) + " rotate " + std::to_string(rotate) +
                          " occluder " + std::to_string(int(occluder.kind)) + " normals " +
                          std::to_string(int(use)));
        }
      }
    }
  }
}

TEST_F(VulkanPoint, BallAgreesAroundIt) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {41, 35}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 2);
      if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
      for (int samples : {1, 12, 64}) {
        PointSettings s = ball(1);
        s.samples = samples;
        s.dual = {.second_radius = 0.2f, .combine = Combine::kMinimum};
        s.blur = true;
        expect_same(in.field(), s, std::to_string(w) + "x" + std::to_string(h));
      }
    }
  }
}

TEST_F(VulkanPoint, APlaneIsOpen) {
  const synthetic::Input in =
      synthetic::plane(60, 44, Camera::perspective(1, 60, 44), 0.3, 0.4, std::sqrt(0.75), 9);
  expect_same(in.field(), ball(1), "plane, ball");
  PointSettings s = ball(1);
  s.pattern = PointPattern::kScreen;
  expect_same(in.field(), s, "plane, screen", true);
}

PointSettings screen(float radius) {
  PointSettings s = ball(radius);
  s.pattern = PointPattern::kScreen;
  return s;
}

TEST_F(VulkanPoint, ScreenAgreesForEverySetting) {
  const synthetic::Input in = synthetic::blocks(90, 60, Camera::perspective(1, 90, 60), 3);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kQuadratic}) {
    for (bool rotate : {false, true}) {
      for (bool blur : {false, true}) {
        PointSettings s = screen(0.7f);
        s.falloff.kind = kind;
        s.rotate = rotate;
        s.blur = blur;
        const std::string what = "kind " + std::to_string(int(kind)) + " rotate " +
                                 std::to_string(rotate) + " blur " + std::to_string(blur);
        expect_same(in.field(), s, what + " directions", true);
        expect_same(in.field(), s, what);
        DepthField field = in.field();
        field.normal_use = NormalUse::kNone;
        expect_same(field, s, what + " no normals");
      }
    }
  }
}

TEST_F(VulkanPoint, ScreenAgreesAroundIt) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {41, 35}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 2);
      if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
      for (int samples : {1, 32}) {
        PointSettings s = screen(1);
        s.samples = samples;
        s.blur = true;
        expect_same(in.field(), s, std::to_string(w) + "x" + std::to_string(h), true);
        s.dual = {.second_radius = 0.2f, .combine = Combine::kMinimum};
        expect_same(in.field(), s, std::to_string(w) + "x" + std::to_string(h) + ", two radii");
      }
    }
  }
}

TEST_F(VulkanPoint, FramesTakeDifferentPatterns) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 7);
  expect_frames_differ(in.field(), ball(1));
  expect_frames_differ(in.field(), screen(1));
}

TEST_F(VulkanPoint, WhatCannotRunIsRefused) {
  const synthetic::Input in = synthetic::blocks(16, 16, Camera::perspective(1, 16, 16), 1);
  std::vector<float> out(4 * 256);
  auto view = [&](int c) { return ImageView<float>{out.data() + 256 * c, 16, 16}; };
  const Outputs directions{.visibility = view(0), .bent_normal = {view(1), view(2), view(3)}};
  EXPECT_EQ(vulkan_->run(in.field(), ball(1), directions).code(), StatusCode::kUnsupported);
  PointSettings s = screen(1);
  s.dual.second_radius = 0.5f;
  EXPECT_EQ(vulkan_->run(in.field(), s, directions).code(), StatusCode::kUnsupported);
  s = screen(1);
  s.samples = 64;
  EXPECT_FALSE(vulkan_->run(in.field(), s, {.visibility = view(0)}).ok());
  s = screen(1);
  s.occluder = Occluder::of_thickness(1);
  EXPECT_FALSE(vulkan_->run(in.field(), s, {.visibility = view(0)}).ok());
}

}  // namespace
}  // namespace obscura
