#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanHalfResolution = VulkanTest;

synthetic::Input scene(int width, int height, std::uint64_t seed, bool orthographic = false) {
  return synthetic::blocks(width, height,
                           orthographic ? Camera::orthographic_height(4, width, height)
                                        : Camera::perspective(1, width, height),
                           seed);
}

template <class Settings>
Settings half() {
  Settings s;
  s.falloff.radius = 1;
  s.resolution = Resolution::kHalf;
  return s;
}

TEST_F(VulkanHalfResolution, EveryMethodAgrees) {
  synthetic::Input in = scene(99, 60, 3);
  in.guard_band = {.left = 3, .right = 2, .top = 1, .bottom = 0};
  expect_same(in.field(), half<AreaSettings>(), "area");
  expect_same(in.field(), half<FarFieldSettings>(), "far-field");
  FarFieldSettings solid = half<FarFieldSettings>();
  solid.occluder = Occluder::solid();
  expect_same(in.field(), solid, "far-field, solid", true);
  FarFieldSettings shared = half<FarFieldSettings>();
  shared.directions = 18;
  shared.separable = 3;
  expect_same(in.field(), shared, "far-field, separable");
  expect_same(in.field(), half<HemisphereSettings>(), "hemisphere", true);
  expect_same(in.field(), half<HorizonSettings>(), "horizon", true);
  expect_same(in.field(), half<LineSettings>(), "line");
  expect_same(in.field(), half<MipmapSettings>(), "mipmap");
  expect_same(in.field(), half<PointSettings>(), "point");
  PointSettings screen = half<PointSettings>();
  screen.pattern = PointPattern::kScreen;
  expect_same(in.field(), screen, "point, screen", true);
}

TEST_F(VulkanHalfResolution, OddSizesGuardBandsParallelViewsAndNoNormals) {
  for (const auto& [w, h] : {std::pair{1, 1}, {2, 2}, {7, 3}, {34, 45}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = scene(w, h, 2, orthographic);
      const std::string what = std::to_string(w) + "x" + std::to_string(h);
      expect_same(in.field(), half<HorizonSettings>(), what, true);
      if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
      expect_same(in.field(), half<HorizonSettings>(), what + " guard band", true);
      DepthField without = in.field();
      without.normal_use = NormalUse::kNone;
      expect_same(without, half<LineSettings>(), what + " no normals");
    }
  }
}

TEST_F(VulkanHalfResolution, WithoutBlurWithTwoRadiiAndInEveryFormat) {
  const synthetic::Input in = scene(64, 48, 6);
  HorizonSettings endless = half<HorizonSettings>();
  endless.falloff = {.kind = FalloffKind::kConstant,
                     .radius = std::numeric_limits<float>::infinity()};
  expect_same(in.field(), endless, "infinite radius");
  LineSettings line = half<LineSettings>();
  line.blur = false;
  expect_same(in.field(), line, "no blur");
  line.dual.second_radius = 0.4f;
  expect_same(in.field(), line, "two radii");
  line.blur = true;
  expect_same(in.field(), line, "two radii, blur");
  for (auto format : {tools::VulkanFormat::kR8, tools::VulkanFormat::kR16F}) {
    expect_same(in.field(), half<HorizonSettings>(), "format " + std::to_string(int(format)), true,
                {.output = format});
  }
}

}  // namespace
}  // namespace obscura
