#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanFarField = VulkanTest;

FarFieldSettings far_field(float radius) {
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = radius;
  s.directions = 8;
  s.segments = 1;
  return s;
}

TEST_F(VulkanFarField, EveryPresetAgrees) {
  for (int seed : {3, 5}) {
    const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), seed);
    for (FarFieldPreset preset :
         {FarFieldPreset::kFast, FarFieldPreset::kBalanced, FarFieldPreset::kHigh}) {
      FarFieldSettings s = far_field(1);
      s.preset = preset;
      expect_same(in.field(), s, "preset " + std::to_string(int(preset)));
    }
  }
}

TEST_F(VulkanFarField, EverySettingAgrees) {
  const synthetic::Input in = synthetic::blocks(70, 52, Camera::perspective(1, 70, 52), 4);
  auto same = [&](const char* what, auto change) {
    FarFieldSettings s = far_field(1);
    change(s);
    expect_same(in.field(), s, what);
  };
  same("slab", [](auto& s) { s.profile = SlabProfile::kSlab; });
  same("slope", [](auto& s) { s.receiver_slope = -1; });
  same("far field alone", [](auto& s) { s.near_field = false; });
  same("near field alone", [](auto& s) { s.interval = 64; });
  same("short intervals", [](auto& s) { s.interval = 2; });
  same("few directions", [](auto& s) { s.directions = 4; });
  same("odd directions", [](auto& s) { s.directions = 13; });
  same("segments", [](auto& s) { s.segments = 8; });
  for (int step : {2, 3, 4}) same("line step", [&](auto& s) { s.line_step = step; });
}

TEST_F(VulkanFarField, EveryFalloffAgrees) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 6);
  for (FalloffKind kind :
       {FalloffKind::kConstant, FalloffKind::kQuadratic, FalloffKind::kInverseSquare,
        FalloffKind::kTable, FalloffKind::kFunction}) {
    FarFieldSettings s = far_field(2);
    s.falloff.kind = kind;
    s.falloff.table = {1, 0.8f, 0.3f, 0.1f};
    s.falloff.function = [](float d) { return 1 / (1 + d); };
    expect_same(in.field(), s, "falloff " + std::to_string(int(kind)));
  }
}

TEST_F(VulkanFarField, OddSizesGuardBandsAndParallelViews) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {33, 65}, {66, 31}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 2);
      for (int band : {0, 1}) {
        if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(band, band);
        FarFieldSettings s = far_field(1);
        s.interval = 4;
        expect_same(in.field(), s, std::to_string(w) + "x" + std::to_string(h));
      }
    }
  }
}

TEST_F(VulkanFarField, DirectionsAgree) {
  for (bool orthographic : {false, true}) {
    synthetic::Input in = synthetic::blocks(
        60, 44,
        orthographic ? Camera::orthographic_height(4, 60, 44) : Camera::perspective(1, 60, 44), 8);
    in.guard_band = GuardBand::symmetric(3, 2);
    for (ConeEstimate cone : {ConeEstimate::kExact, ConeEstimate::kPaper}) {
      FarFieldSettings s = far_field(1);
      s.cone = cone;
      expect_same(in.field(), s, "cone " + std::to_string(int(cone)), true);
    }
  }
}

TEST_F(VulkanFarField, MatterOfAThicknessAgrees) {
  for (bool orthographic : {false, true}) {
    synthetic::Input in = synthetic::blocks(
        75, 56,
        orthographic ? Camera::orthographic_height(4, 75, 56) : Camera::perspective(1, 75, 56), 4);
    in.guard_band = GuardBand::symmetric(2, 1);
    auto same = [&](const char* what, bool directions, auto change) {
      FarFieldSettings s = far_field(1);
      s.occluder = Occluder::of_thickness(0.3f);
      change(s);
      expect_same(in.field(), s, what, directions);
    };
    same("thickness", true, [](auto&) {});
    same("endless", false, [](auto& s) { s.occluder = Occluder::of_thickness(1e30f); });
    same("short intervals", false, [](auto& s) { s.interval = 2; });
    same("slope", false, [](auto& s) { s.receiver_slope = -1; });
    same("far field alone", false, [](auto& s) { s.near_field = false; });
    same("3x3", false, [](auto& s) {
      s.directions = 9;
      s.separable = 3;
    });
    same("2x2", true, [](auto& s) {
      s.directions = 8;
      s.separable = 2;
    });
    same("every second line", false, [](auto& s) { s.line_step = 2; });
  }
}

// Back depths of all kinds: before the front, behind it, and missing.
TEST_F(VulkanFarField, BackDepthAgrees) {
  for (DepthKind kind : {DepthKind::kLinear, DepthKind::kNdcReversed}) {
    synthetic::Input in = synthetic::blocks(75, 56, Camera::perspective(1, 75, 56), 4);
    in.guard_band = GuardBand::symmetric(2, 1);
    std::vector<float> back(in.depth.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      back[i] = in.depth[i] + 0.1f * static_cast<float>(i % 7) - 0.05f;
      if (i % 11 == 0) back[i] = std::numeric_limits<float>::infinity();
    }
    if (kind == DepthKind::kNdcReversed) {
      for (std::vector<float>* image : {&in.depth, &back}) {
        for (float& d : *image) d = 0.1f / d;
      }
    }
    DepthField field = in.field();
    field.depth_kind = kind;
    field.near_plane = 0.1f;
    field.far_plane = std::numeric_limits<float>::infinity();
    field.back_depth = {back.data(), 75, 56};
    for (Resolution resolution : {Resolution::kFull, Resolution::kHalf}) {
      FarFieldSettings s = far_field(1);
      s.occluder = Occluder::back_depth();
      s.resolution = resolution;
      expect_same(field, s, "kind " + std::to_string(int(kind)), true);
    }
  }
}

// As thick as wide, of one, few and many groups of rows and columns.
TEST_F(VulkanFarField, MatterAsThickAsWideAgrees) {
  for (const bool orthographic : {false, true}) {
    for (const auto& [w, h] : {std::pair{75, 56}, {23, 131}}) {
      const Camera camera =
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1, w, h);
      synthetic::Input in = synthetic::blocks(w, h, camera, 4);
      in.guard_band = GuardBand::symmetric(2, 1);
      for (Resolution resolution : {Resolution::kFull, Resolution::kHalf}) {
        FarFieldSettings s = far_field(1);
        s.occluder = Occluder::automatic();
        s.resolution = resolution;
        // Filling in enlarges what a sector's rounding moves in directions.
        expect_same(in.field(), s, "width " + std::to_string(w), resolution == Resolution::kFull);
      }
    }
  }
}

// Groups of side x side pixels; 1: jitter.
FarFieldSettings shared_work(int side, int line_step) {
  FarFieldSettings s = far_field(1);
  s.directions = side == 3 ? 18 : 8;
  s.separable = side;
  s.jitter = side == 1;
  s.blur = false;
  s.line_step = line_step;
  return s;
}

// Separable evaluation and jitter (Timonen 2013, sections 10 and 11.1).
TEST_F(VulkanFarField, SharedWorkAgrees) {
  synthetic::Input in = synthetic::blocks(58, 41, Camera::perspective(1, 58, 41), 11);
  in.guard_band = GuardBand::symmetric(2, 1);
  for (int side : {1, 2, 3}) {
    for (int line_step : {1, 2}) {
      expect_same(in.field(), shared_work(side, line_step),
                  "side " + std::to_string(side) + ", step " + std::to_string(line_step),
                  line_step == 1);
    }
  }
}

// At the thresholds of the blur rounding decides, always for two pixels at a time. In a large image
// they are a small share.
TEST_F(VulkanFarField, SelectiveBlurAgrees) {
  synthetic::Input in = synthetic::blocks(125, 90, Camera::perspective(1, 125, 90), 11);
  in.guard_band = GuardBand::symmetric(2, 1);
  FarFieldSettings s = shared_work(1, 1);
  s.blur = true;
  s.near_step = NearStep::of(2);
  expect_same(in.field(), s, "jitter", true);
}

TEST_F(VulkanFarField, SharedWorkAgreesForParallelViews) {
  const synthetic::Input in = synthetic::blocks(33, 50, Camera::orthographic_height(4, 33, 50), 12);
  FarFieldSettings s = far_field(1);
  s.directions = 9;
  s.separable = 3;
  expect_same(in.field(), s, "3x3");
  s.near_field = false;
  expect_same(in.field(), s, "3x3, far field alone");
  s = far_field(1);
  s.preset = FarFieldPreset::kFast;
  expect_same(in.field(), s, "2x2");
}

// A temporal filter needs this: frames in which each pixel is each cell of its group equally often
// have a smaller error than one.
TEST_F(VulkanFarField, FramesMoveWhoDoesWhat) {
  const int w = 60, h = 46;
  const std::size_t pixels = std::size_t{60} * 46;
  const synthetic::Input in = synthetic::blocks(w, h, Camera::perspective(1, w, h), 7);
  for (int side : {1, 2, 3}) {
    FarFieldSettings s = shared_work(side, 1), whole = s;
    s.near_field = whole.near_field = false;
    whole.separable = 1;
    whole.jitter = false;
    if (side == 1) whole.segments = 8;
    std::vector<float> converged(pixels), v(pixels), mean(pixels, 0.0f);
    ASSERT_TRUE(compute(in.field(), whole, {.visibility = {converged.data(), w, h}}).ok());
    auto error = [&](const std::vector<float>& a) {
      double sum = 0;
      for (std::size_t i = 0; i < pixels; ++i) sum += std::abs(a[i] - converged[i]);
      return sum / pixels;
    };
    double single = 0;
    const std::vector<std::uint32_t> frames =
        side == 2 ? std::vector<std::uint32_t>{0, 1, 4, 5}
                  : std::vector<std::uint32_t>{0, 1, 2, 4, 5, 6, 8, 9, 10};
    const double weight = 1.0 / static_cast<double>(frames.size());
    for (std::uint32_t frame : frames) {
      const Status status = vulkan_->run(in.field(), s, {.visibility = {v.data(), w, h}}, nullptr,
                                         {.frame_index = frame});
      ASSERT_TRUE(status.ok()) << status.message();
      single += weight * error(v);
      for (std::size_t i = 0; i < pixels; ++i) mean[i] += static_cast<float>(weight) * v[i];
    }
    EXPECT_LT(error(mean), 0.8 * single) << side;
  }
}

// More scanned lines than one batch of directions holds, and more lines than one group sums.
TEST_F(VulkanFarField, ManyBatchesAgree) {
  const synthetic::Input in = synthetic::blocks(600, 400, Camera::perspective(1, 600, 400), 9);
  FarFieldSettings s = far_field(3);
  s.directions = 12;
  s.interval = 2;
  s.near_field = false;
  expect_same(in.field(), s, "batches");
}

TEST_F(VulkanFarField, WhatCannotRunIsRefused) {
  const synthetic::Input in = synthetic::blocks(16, 16, Camera::perspective(1, 16, 16), 1);
  std::vector<float> out(256);
  const ImageView<float> view{out.data(), 16, 16};
  FarFieldSettings s = far_field(1);
  s.directions = 3;
  EXPECT_EQ(vulkan_->run(in.field(), s, {.visibility = view}).code(), StatusCode::kInvalidArgument);
  DepthField field = in.field();
  field.normal_use = NormalUse::kNone;
  EXPECT_FALSE(vulkan_->run(field, far_field(1), {.visibility = view}).ok());
  s = far_field(1);
  s.occluder = Occluder::back_depth();
  EXPECT_FALSE(vulkan_->run(in.field(), s, {.visibility = view}).ok());
}

}  // namespace
}  // namespace obscura
