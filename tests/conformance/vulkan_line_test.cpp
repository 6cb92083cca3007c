#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

using VulkanLine = VulkanTest;

LineSettings line(float radius) {
  LineSettings s;
  s.falloff.radius = radius;
  s.blur = false;
  return s;
}

TEST_F(VulkanLine, AgreesForEverySetting) {
  const synthetic::Input in = synthetic::blocks(150, 90, Camera::perspective(1, 150, 90), 3);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kQuadratic}) {
    for (bool rotate : {false, true}) {
      for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.3f)}) {
        for (SphereKind sphere : {SphereKind::kCentered, SphereKind::kTangent}) {
          LineSettings s = line(0.7f);
          s.falloff.kind = kind;
          s.rotate = rotate;
          s.occluder = occluder;
          s.sphere = sphere;
          expect_same(in.field(), s,
                      "kind " + std::to_string(int(kind)) + " rotate " + std::to_string(rotate) +
                          " occluder " + std::to_string(int(occluder.kind)) + " sphere " +
                          std::to_string(int(sphere)));
        }
      }
    }
  }
}

TEST_F(VulkanLine, AgreesForEveryNumberOfSamples) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 5);
  for (int samples : {1, 5, 9, 32}) {
    LineSettings s = line(1);
    s.samples = samples;
    expect_same(in.field(), s, std::to_string(samples));
  }
}

TEST_F(VulkanLine, OddSizesGuardBandsAndParallelViews) {
  for (const auto& [w, h] : {std::pair{1, 1}, {7, 3}, {33, 65}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 2);
      if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(1, 1);
      expect_same(in.field(), line(1), std::to_string(w) + "x" + std::to_string(h));
      DepthField without = in.field();
      without.normal_use = NormalUse::kNone;
      expect_same(without, line(1), "no normals");
    }
  }
}

TEST_F(VulkanLine, GivenNormalsAndEveryKindOfDepth) {
  const synthetic::Input plane =
      synthetic::plane(60, 44, Camera::perspective(1, 60, 44), 0.3, 0.4, std::sqrt(0.75), 9);
  expect_same(plane.field(), line(1), "given normals");
  synthetic::Input in = synthetic::blocks(60, 44, Camera::perspective(1, 60, 44), 4);
  const std::vector<float> linear = in.depth;
  for (DepthKind kind : {DepthKind::kDistance, DepthKind::kNdc, DepthKind::kNdcReversed}) {
    for (float far_plane : {100.0f, kInf}) {
      DepthField field = in.field();
      field.depth_kind = kind;
      field.near_plane = 0.1f;
      field.far_plane = far_plane;
      for (std::size_t i = 0; i < linear.size(); ++i) {
        const double z = linear[i], n = 0.1, f = far_plane;
        const double reversed = std::isinf(z)   ? 0
                                : std::isinf(f) ? n / z
                                                : n * (f - z) / (z * (f - n));
        in.depth[i] = static_cast<float>(kind == DepthKind::kDistance ? z
                                         : kind == DepthKind::kNdc    ? 1 - reversed
                                                                      : reversed);
      }
      for (bool depth_buffer : {false, true}) {
        if (depth_buffer && kind == DepthKind::kDistance) continue;  // D32 holds [0, 1]
        expect_same(field, line(1), "kind " + std::to_string(int(kind)), false,
                    {.depth_buffer = depth_buffer});
      }
    }
  }
}

// Sizes around that of a tile; the blur does not read results of the guard band.
TEST_F(VulkanLine, BlurAgrees) {
  for (const auto& [w, h] : {std::pair{1, 1}, {5, 40}, {33, 25}, {97, 75}}) {
    for (bool orthographic : {false, true}) {
      synthetic::Input in = synthetic::blocks(
          w, h,
          orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(1.2f, w, h), 7);
      for (int band : {0, 1}) {
        if (w > 2 && h > 2) in.guard_band = GuardBand::symmetric(band, band);
        for (float radius : {0.05f, 0.7f}) {
          LineSettings s = line(radius);
          s.blur = true;
          expect_same(in.field(), s, std::to_string(w) + "x" + std::to_string(h));
        }
      }
    }
  }
}

TEST_F(VulkanLine, TwoRadiiAgree) {
  const synthetic::Input in = synthetic::blocks(70, 50, Camera::perspective(1, 70, 50), 8);
  for (Combine combine : {Combine::kProduct, Combine::kMinimum}) {
    for (bool blur : {false, true}) {
      LineSettings s = line(1.5f);
      s.dual = {.second_radius = 0.3f, .combine = combine};
      s.blur = blur;
      expect_same(in.field(), s, "combine " + std::to_string(int(combine)));
    }
  }
}

TEST_F(VulkanLine, EveryFormatOfVisibility) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 6);
  for (auto format : {tools::VulkanFormat::kR8, tools::VulkanFormat::kR16F}) {
    expect_same(in.field(), line(1), "format", false, {.output = format});
  }
}

// A temporal filter needs this: the mean of 16 frames has a smaller error than one frame.
TEST_F(VulkanLine, FramesTakeDifferentPatterns) {
  const synthetic::Input in = synthetic::blocks(64, 48, Camera::perspective(1, 64, 48), 7);
  LineSettings s = line(1);
  s.samples = 5;
  const std::size_t pixels = std::size_t{64} * 48;
  std::vector<float> converged(pixels), v(pixels), mean(pixels, 0.0f);
  // The mean over random rotations of the pattern of five; another pattern would give another
  // integral.
  LineSettings many = s;
  for (; many.seed <= 64; ++many.seed) {
    ASSERT_TRUE(compute(in.field(), many, {.visibility = {v.data(), 64, 48}}).ok());
    for (std::size_t i = 0; i < pixels; ++i) converged[i] += v[i] / 64;
  }
  auto error = [&](const std::vector<float>& a) {
    double sum = 0;
    for (std::size_t i = 0; i < pixels; ++i) sum += std::abs(a[i] - converged[i]);
    return sum / pixels;
  };
  double single = 0;
  for (std::uint32_t frame = 0; frame < 16; ++frame) {
    const Status status = vulkan_->run(in.field(), s, {.visibility = {v.data(), 64, 48}}, nullptr,
                                       {.frame_index = frame});
    ASSERT_TRUE(status.ok()) << status.message();
    single += error(v) / 16;
    for (std::size_t i = 0; i < pixels; ++i) mean[i] += v[i] / 16;
  }
  EXPECT_LT(error(mean), 0.5 * single);
}

TEST_F(VulkanLine, WhatCannotRunIsRefused) {
  const synthetic::Input in = synthetic::blocks(16, 16, Camera::perspective(1, 16, 16), 1);
  std::vector<float> out(256);
  const ImageView<float> view{out.data(), 16, 16};
  EXPECT_EQ(vulkan_->run(in.field(), ReferenceSettings{}, {.visibility = view}).code(),
            StatusCode::kUnsupported);
  EXPECT_FALSE(vulkan_->run(in.field(), line(1), {}).ok());
  LineSettings s = line(-1);
  EXPECT_FALSE(vulkan_->run(in.field(), s, {.visibility = view}).ok());
  s = line(1);
  s.dual.second_radius = -1.0f;
  EXPECT_FALSE(vulkan_->run(in.field(), s, {.visibility = view}).ok());
}

// Without a near plane NDC depth would be background everywhere.
TEST_F(VulkanLine, AViewThatCannotBeIsRefusedAsOnTheProcessor) {
  const synthetic::Input in = synthetic::blocks(16, 16, Camera::perspective(1, 16, 16), 1);
  std::vector<float> out(256, -1.0f);
  const Outputs outputs{.visibility = {out.data(), 16, 16}};
  DepthField no_near = in.field(), far_before_near = in.field(), no_scale = in.field();
  no_near.depth_kind = DepthKind::kNdcReversed;
  far_before_near.depth_kind = DepthKind::kNdc;
  far_before_near.near_plane = 2;
  far_before_near.far_plane = 1;
  no_scale.camera.scale_x = 0;
  for (const DepthField& field : {no_near, far_before_near, no_scale}) {
    const Status gpu = vulkan_->run(field, line(1), outputs);
    EXPECT_FALSE(gpu.ok());
    EXPECT_EQ(gpu.message(), compute(field, line(1), outputs).message());
  }
  EXPECT_EQ(out, std::vector<float>(256, -1.0f));
  const Status after = vulkan_->run(in.field(), line(1), outputs);
  EXPECT_TRUE(after.ok()) << after.message();
}

}  // namespace
}  // namespace obscura
