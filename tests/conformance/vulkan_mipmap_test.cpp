#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanMipmap = VulkanTest;

MipmapSettings mipmap(float radius) {
  MipmapSettings s;
  s.falloff.radius = radius;
  s.directions = 8;
  return s;
}

TEST_F(VulkanMipmap, EverySettingAgrees) {
  for (int seed : {3, 4}) {
    const synthetic::Input in = synthetic::blocks(70, 52, Camera::perspective(1, 70, 52), seed);
    for (DepthPyramid pyramid : {DepthPyramid::kAverage, DepthPyramid::kNearest}) {
      for (float factor : {1.06f, 1.5f, 4.0f}) {
        for (int directions : {4, 13}) {
          MipmapSettings s = mipmap(1);
          s.pyramid = pyramid;
          s.step_factor = factor;
          s.directions = directions;
          expect_same(in.field(), s,
                      "pyramid " + std::to_string(int(pyramid)) + " factor " +
                          std::to_string(factor) + " directions " + std::to_string(directions));
        }
      }
    }
  }
}

TEST_F(VulkanMipmap, EveryFalloffAgrees) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 6);
  for (FalloffKind kind :
       {FalloffKind::kConstant, FalloffKind::kQuadratic, FalloffKind::kInverseSquare,
        FalloffKind::kTable, FalloffKind::kFunction}) {
    MipmapSettings s = mipmap(2);
    s.falloff.kind = kind;
    s.falloff.table = {1, 0.8f, 0.3f, 0.1f};
    s.falloff.function = [](float d) { return 1 / (1 + d); };
    expect_same(in.field(), s, "falloff " + std::to_string(int(kind)));
  }
}

// Sizes around those of a tile of the pyramid, and more levels than one pass makes.
TEST_F(VulkanMipmap, OddSizesGuardBandsAndParallelViews) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {33, 65}, {64, 31}, {150, 5}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 2);
      for (int band : {0, 1}) {
        if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(band, band);
        expect_same(in.field(), mipmap(1), std::to_string(w) + "x" + std::to_string(h));
      }
    }
  }
}

TEST_F(VulkanMipmap, WhatCannotRunIsRefused) {
  const synthetic::Input in = synthetic::blocks(16, 16, Camera::perspective(1, 16, 16), 1);
  std::vector<float> out(256);
  const ImageView<float> view{out.data(), 16, 16};
  MipmapSettings s = mipmap(1);
  s.step_factor = 1;
  EXPECT_EQ(vulkan_->run(in.field(), s, {.visibility = view}).code(), StatusCode::kInvalidArgument);
  DepthField field = in.field();
  field.normal_use = NormalUse::kNone;
  EXPECT_FALSE(vulkan_->run(field, mipmap(1), {.visibility = view}).ok());
}

}  // namespace
}  // namespace obscura
