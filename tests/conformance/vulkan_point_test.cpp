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
  expect_same(in.field(), ball(1), "plane");
}

}  // namespace
}  // namespace obscura
