#include <gtest/gtest.h>

#include <vector>

#include "obscura/estimator.h"

namespace obscura {
namespace {

// A floor beside a step: constant light gives visibility times the light, and light that is linear
// in direction what the cosine integral says.
TEST(ReferenceRadiance, RaysCarryTheirLight) {
  constexpr int kSize = 16;
  std::vector<float> depth(kSize * kSize, 5.0f), visibility(depth), rgb(3 * depth.size(), 0.0f);
  std::vector<float> integral(rgb);
  for (int i = 0; i < kSize * kSize; ++i) {
    if (i % kSize < 5) depth[i] = 4.9f;
  }
  DepthField field;
  field.depth = ImageView<const float>(depth.data(), kSize, kSize);
  field.camera = Camera::orthographic_height(1, kSize, kSize);
  Outputs o;
  o.visibility = ImageView<float>(visibility.data(), kSize, kSize);
  o.radiance = VectorView<float>::interleaved(rgb.data(), kSize, kSize);
  o.cosine_integral = VectorView<float>::interleaved(integral.data(), kSize, kSize);
  ReferenceSettings s{.occluder = Occluder::solid(), .rays = 256};
  s.radiance = [](const std::array<float, 3>& w) { return std::array<float, 3>{2, 1 + w[0], 0}; };
  ASSERT_TRUE(compute(field, s, o).ok());
  for (int i = 0; i < kSize * kSize; ++i) {
    EXPECT_NEAR(rgb[3 * i], 2 * visibility[i], 1e-5);
    EXPECT_NEAR(rgb[3 * i + 1], visibility[i] + integral[3 * i], 1e-5);
    EXPECT_EQ(rgb[3 * i + 2], 0);
  }
  s.radiance = {};
  EXPECT_EQ(compute(field, s, o).code(), StatusCode::kUnsupported);
}

}  // namespace
}  // namespace obscura
