#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

using VulkanHorizon = VulkanTest;

HorizonSettings horizon(HorizonVariant variant = HorizonVariant::kSlices) {
  HorizonSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = 0.7f;
  s.variant = variant;
  return s;
}

synthetic::Input scene(int width, int height, std::uint64_t seed, bool orthographic = false) {
  return synthetic::blocks(width, height,
                           orthographic ? Camera::orthographic_height(4, width, height)
                                        : Camera::perspective(1, width, height),
                           seed);
}

TEST_F(VulkanHorizon, SlicesAgreeForEveryFalloffAndProfile) {
  const synthetic::Input in = scene(80, 50, 3);
  Falloff table{.kind = FalloffKind::kTable, .radius = 2};
  table.table = {1, 0.9f, 0.3f, 0.1f};
  Falloff function{.kind = FalloffKind::kFunction};
  function.function = [](float d) { return 1 / (1 + 3 * d); };
  for (const Falloff& falloff :
       {Falloff{.kind = FalloffKind::kConstant, .radius = 0.7f},
        Falloff{.kind = FalloffKind::kExponential, .radius = 0.7f},
        Falloff{.kind = FalloffKind::kQuadratic, .radius = 1.5f},
        Falloff{.kind = FalloffKind::kInverseSquare, .radius = 0.3f},
        Falloff{.kind = FalloffKind::kConstant, .radius = kInf}, table, function}) {
    for (SlabProfile profile : {SlabProfile::kSlab, SlabProfile::kAdaptiveChord}) {
      HorizonSettings s = horizon();
      s.falloff = falloff;
      s.profile = profile;
      s.blur = false;
      const std::string what =
          "kind " + std::to_string(int(falloff.kind)) + " profile " + std::to_string(int(profile));
      expect_same(in.field(), s, what);
      expect_same(in.field(), s, what + " directions", true);
    }
  }
}

TEST_F(VulkanHorizon, MatterAgreesForEveryOccluder) {
  for (const bool orthographic : {false, true}) {
    synthetic::Input in = scene(75, 56, 4, orthographic);
    in.guard_band = GuardBand::symmetric(2, 1);
    std::vector<float> back(in.depth.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      back[i] = in.depth[i] + 0.1f * static_cast<float>(i % 7) - 0.05f;
      if (i % 11 == 0) back[i] = kInf;
    }
    DepthField field = in.field();
    const auto same = [&](const std::string& what, const Occluder& occluder, FalloffKind kind) {
      HorizonSettings s = horizon();
      s.occluder = occluder;
      s.falloff.kind = kind;
      expect_same(field, s, what);
      s.blur = false;
      expect_same(field, s, what + " without blur");
      s.resolution = Resolution::kHalf;
      expect_same(field, s, what + " half");
      // A sector more or less turns directions by more than it changes what is seen.
      s = horizon();
      s.occluder = occluder;
      s.directions = 64;
      expect_same(field, s, what + " directions", true);
    };
    for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential}) {
      same("thickness", Occluder::of_thickness(0.3f), kind);
      same("endless", Occluder::of_thickness(1e30f), kind);
      same("as thick as wide", Occluder::automatic(), kind);
      field.back_depth = {back.data(), 75, 56};
      same("back depth", Occluder::back_depth(), kind);
      field.back_depth = {};
    }
  }
}

TEST_F(VulkanHorizon, AgreesForEveryPatternWithBlurAndWithout) {
  const synthetic::Input in = scene(61, 43, 8);
  for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    for (int interleave : {1, 2, 3, 4, 8}) {
      for (bool blur : {false, true}) {
        HorizonSettings s = horizon(variant);
        s.interleave = interleave;
        s.blur = blur;
        s.directions = 2 + interleave;
        s.steps = interleave == 8 ? 1 : 6;
        s.cone = blur ? ConeEstimate::kPaper : ConeEstimate::kExact;
        const std::string what = "variant " + std::to_string(int(variant)) + " m " +
                                 std::to_string(interleave) + " blur " + std::to_string(blur);
        expect_same(in.field(), s, what, blur);
      }
    }
  }
}

TEST_F(VulkanHorizon, OddSizesGuardBandsAndParallelViews) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {33, 45}}) {
    for (bool orthographic : {false, true}) {
      for (HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
        synthetic::Input in = scene(w, h, 2, orthographic);
        if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
        expect_same(in.field(), horizon(variant), std::to_string(w) + "x" + std::to_string(h),
                    true);
      }
    }
  }
}

// With an infinite radius the blur separates surfaces by a share of the farthest depth.
TEST_F(VulkanHorizon, TheFarthestDepthBoundsTheBlur) {
  const synthetic::Input in = scene(60, 44, 4);
  HorizonSettings s = horizon();
  s.falloff = {.kind = FalloffKind::kConstant, .radius = kInf};
  expect_same(in.field(), s, "infinite radius");
  expect_same(in.field(), s, "infinite radius, directions", true);
}

TEST_F(VulkanHorizon, EveryFormat) {
  const synthetic::Input in = scene(64, 48, 6);
  for (auto format : {tools::VulkanFormat::kR8, tools::VulkanFormat::kR16F}) {
    expect_same(in.field(), horizon(), "format " + std::to_string(int(format)), true,
                {.output = format});
  }
}

// Frame 5 moves a pattern of 4 x 4 by (5, 1). An orthographic view that is moved by as much then
// gives the result of frame 0.
TEST_F(VulkanHorizon, FramesMoveThePattern) {
  const int w = 60, h = 44, dx = 5, dy = 1, margin = 8;
  const synthetic::Input in = scene(w, h, 9, true);
  synthetic::Input moved = in;
  for (int y = 0; y + dy < h; ++y) {
    for (int x = 0; x + dx < w; ++x) {
      moved.depth[std::size_t(y) * w + x] = in.depth[std::size_t(y + dy) * w + x + dx];
    }
  }
  HorizonSettings s = horizon();
  s.falloff = {.kind = FalloffKind::kConstant, .radius = 0.4f};
  s.blur = false;
  std::vector<float> still(std::size_t(w) * h), later(still), other(still);
  auto run = [&](const synthetic::Input& input, std::uint32_t frame, std::vector<float>& out) {
    const Status status = vulkan_->run(input.field(), s, {.visibility = {out.data(), w, h}},
                                       nullptr, {.frame_index = frame});
    ASSERT_TRUE(status.ok()) << status.message();
  };
  run(in, 0, still);
  run(moved, 5, later);
  run(moved, 0, other);
  double same = 0, different = 0;
  for (int y = margin; y < h - margin; ++y) {
    for (int x = margin; x < w - margin - dx; ++x) {
      const float expected = still[std::size_t(y + dy) * w + x + dx];
      same = std::max(same, std::abs(double{expected} - later[std::size_t(y) * w + x]));
      different = std::max(different, std::abs(double{expected} - other[std::size_t(y) * w + x]));
    }
  }
  EXPECT_LT(same, 1e-3);
  EXPECT_GT(different, 0.05);
}

TEST_F(VulkanHorizon, WhatCannotRunIsRefused) {
  const synthetic::Input in = scene(16, 16, 1);
  std::vector<float> out(256);
  const Outputs outputs{.visibility = {out.data(), 16, 16}};
  DepthField field = in.field();
  field.normal_use = NormalUse::kNone;
  EXPECT_EQ(vulkan_->run(field, horizon(), outputs).code(), StatusCode::kUnsupported);
  HorizonSettings s = horizon(HorizonVariant::kClassic);
  s.falloff.radius = kInf;
  EXPECT_FALSE(vulkan_->run(in.field(), s, outputs).ok());
}

}  // namespace
}  // namespace obscura
