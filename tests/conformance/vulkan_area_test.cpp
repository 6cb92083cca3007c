#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanArea = VulkanTest;

AreaSettings area(float radius, int samples) {
  AreaSettings s;
  s.falloff.radius = radius;
  s.samples = samples;
  s.blur = false;
  return s;
}

TEST_F(VulkanArea, AgreesForEverySetting) {
  const synthetic::Input in = synthetic::blocks(90, 60, Camera::perspective(1, 90, 60), 3);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kQuadratic}) {
    for (bool rotate : {false, true}) {
      for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.3f)}) {
        for (NormalUse use : {NormalUse::kAuto, NormalUse::kNone}) {
          AreaSettings s = area(0.7f, 4);
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

TEST_F(VulkanArea, GivenNormals) {
  const synthetic::Input in =
      synthetic::plane(60, 44, Camera::perspective(1, 60, 44), 0.3, 0.4, std::sqrt(0.75), 9);
  for (float radius : {0.5f, 3.0f}) expect_same(in.field(), area(radius, 3), "plane");
}

// A floor that reaches to the horizon, where kernels end before it.
TEST_F(VulkanArea, OpenFloor) {
  const synthetic::Input in = synthetic::plane(160, 90, Camera::perspective(0.9f, 160, 90), 0,
                                               std::cos(0.05), std::sin(0.05), 1 / std::sin(0.05));
  for (float radius : {0.2f, 1.0f, 5.0f}) expect_same(in.field(), area(radius, 1), "floor");
}

// Large radii in a large image see every level; images of one level have no pyramid.
TEST_F(VulkanArea, AgreesOnEveryLevel) {
  const synthetic::Input in = synthetic::blocks(301, 257, Camera::perspective(1, 301, 257), 4);
  for (float radius : {0.02f, 0.3f, 1.5f, 10.0f}) {
    for (int samples : {1, 9}) expect_same(in.field(), area(radius, samples), "level");
  }
}

TEST_F(VulkanArea, AgreesAroundIt) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {17, 9}, {41, 35}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 2);
      if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
      AreaSettings s = area(1, 5);
      s.center = true;
      s.dual = {.second_radius = 0.2f, .combine = Combine::kProduct};
      s.blur = true;
      expect_same(in.field(), s, std::to_string(w) + "x" + std::to_string(h));
    }
  }
}

TEST_F(VulkanArea, FramesTakeDifferentPatterns) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 7);
  expect_frames_differ(in.field(), area(1, 4));
}

}  // namespace
}  // namespace obscura
