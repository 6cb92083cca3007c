#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanHemisphere = VulkanTest;

HemisphereSettings hemisphere() {
  HemisphereSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = 0.7f;
  return s;
}

synthetic::Input scene(int width, int height, std::uint64_t seed, bool orthographic = false) {
  return synthetic::blocks(width, height,
                           orthographic ? Camera::orthographic_height(4, width, height)
                                        : Camera::perspective(1, width, height),
                           seed);
}

TEST_F(VulkanHemisphere, AgreesForEverySetting) {
  const synthetic::Input in = scene(80, 50, 3);
  std::vector<float> back(in.depth.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    back[i] = in.depth[i] + 0.1f * static_cast<float>(i % 7) - 0.05f;
  }
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kQuadratic}) {
    for (const Occluder& occluder : {Occluder::solid(), Occluder::of_thickness(0.3f),
                                     Occluder::automatic(), Occluder::back_depth()}) {
      for (RayWeighting weighting : {RayWeighting::kCosine, RayWeighting::kUniform}) {
        HemisphereSettings s = hemisphere();
        s.falloff.kind = kind;
        s.occluder = occluder;
        s.weighting = weighting;
        s.blur = false;
        const std::string what = "kind " + std::to_string(int(kind)) + " occluder " +
                                 std::to_string(int(occluder.kind)) + " weighting " +
                                 std::to_string(int(weighting));
        DepthField field = in.field();
        if (occluder.kind == OccluderKind::kBackDepth) field.back_depth = {back.data(), 80, 50};
        expect_same(field, s, what);
        s.blur = true;
        expect_same(field, s, what + " directions", true);
      }
    }
  }
}

TEST_F(VulkanHemisphere, AgreesForEveryPattern) {
  const synthetic::Input in = scene(61, 43, 8);
  for (int interleave : {1, 2, 3, 4, 8}) {
    for (int steps : {0, 5}) {
      HemisphereSettings s = hemisphere();
      s.interleave = interleave;
      s.steps = steps;
      s.samples = 2 + 3 * interleave;
      s.cone = steps > 0 ? ConeEstimate::kPaper : ConeEstimate::kExact;
      expect_same(in.field(), s,
                  "m " + std::to_string(interleave) + " steps " + std::to_string(steps), true);
    }
  }
}

TEST_F(VulkanHemisphere, OddSizesGuardBandsAndParallelViews) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {33, 45}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = scene(w, h, 2, orthographic);
      if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
      HemisphereSettings s = hemisphere();
      s.occluder = Occluder::of_thickness(0.5f);
      const std::string what = std::to_string(w) + "x" + std::to_string(h);
      expect_same(in.field(), hemisphere(), what, true);
      expect_same(in.field(), s, what + " thickness");
    }
  }
}

TEST_F(VulkanHemisphere, EveryFormat) {
  const synthetic::Input in = scene(64, 48, 6);
  for (auto format : {tools::VulkanFormat::kR8, tools::VulkanFormat::kR16F}) {
    expect_same(in.field(), hemisphere(), "format " + std::to_string(int(format)), true,
                {.output = format});
  }
}

TEST_F(VulkanHemisphere, FramesTakeDifferentPatterns) {
  const synthetic::Input in = scene(32, 24, 4);
  expect_frames_differ(in.field(), hemisphere());
}

TEST_F(VulkanHemisphere, WhatCannotRunIsRefused) {
  const synthetic::Input in = scene(16, 16, 1);
  std::vector<float> out(256);
  const Outputs outputs{.visibility = {out.data(), 16, 16}};
  DepthField field = in.field();
  field.normal_use = NormalUse::kNone;
  EXPECT_EQ(vulkan_->run(field, hemisphere(), outputs).code(), StatusCode::kUnsupported);
  HemisphereSettings s = hemisphere();
  s.falloff.kind = FalloffKind::kExponential;
  EXPECT_FALSE(vulkan_->run(in.field(), s, outputs).ok());
}

}  // namespace
}  // namespace obscura
