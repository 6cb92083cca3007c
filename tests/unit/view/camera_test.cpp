#include "obscura/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

TEST(Camera, PerspectiveMapsTheEdgesOfTheFieldOfView) {
  const GuardBand guard = GuardBand::symmetric(10, 20);
  const Camera c = Camera::perspective(std::numbers::pi_v<float> / 2, 200, 100, guard);
  EXPECT_FLOAT_EQ(c.center_u, 110);
  EXPECT_FLOAT_EQ(c.center_v, 70);
  // At 45 degrees half-angle y = depth at the top edge of the visible part, v = 20.
  EXPECT_NEAR((c.center_v - 20) * c.scale_y, 1, 1e-6);
  EXPECT_FLOAT_EQ(c.scale_x, c.scale_y);
}

TEST(Camera, ProjectionMatrixAgreesWithFieldOfView) {
  const double f = 1 / std::tan(0.3), aspect = 2;
  const double m[16] = {f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, -1.01, -0.2, 0, 0, -1, 0};
  Camera c;
  ASSERT_TRUE(Camera::from_projection(m, 200, 100, GuardBand::symmetric(3, 4), &c).ok());
  const Camera d = Camera::perspective(0.6f, 200, 100, GuardBand::symmetric(3, 4));
  EXPECT_NEAR(c.scale_x, d.scale_x, 1e-8);
  EXPECT_NEAR(c.scale_y, d.scale_y, 1e-8);
  EXPECT_FLOAT_EQ(c.center_u, d.center_u);
  EXPECT_FLOAT_EQ(c.center_v, d.center_v);
}

TEST(Camera, OffCentreProjectionMovesTheAxis) {
  // glFrustum(-1, 3, -1, 1, 1, ...): the axis is a quarter of the way from the left edge.
  const double m[16] = {0.5, 0, 0.5, 0, 0, 1, 0, 0, 0, 0, -1, -2, 0, 0, -1, 0};
  Camera c;
  ASSERT_TRUE(Camera::from_projection(m, 400, 200, {}, &c).ok());
  EXPECT_NEAR(c.center_u, 100, 1e-4);
  EXPECT_NEAR(c.center_v, 100, 1e-4);
  EXPECT_NEAR((400 - c.center_u) * c.scale_x, 3, 1e-5);
}

TEST(Camera, ParallelProjection) {
  const double m[16] = {0.5, 0, 0, 0, 0, 0.25, 0, 0.5, 0, 0, -1, 0, 0, 0, 0, 1};
  Camera c;
  ASSERT_TRUE(Camera::from_projection(m, 100, 100, {}, &c).ok());
  EXPECT_TRUE(c.orthographic);
  EXPECT_NEAR(c.scale_y, 0.08, 1e-7);
  EXPECT_NEAR(c.center_v, 25, 1e-4);  // y = 0 lies at ndc 0.5, a quarter from the top
}

TEST(Camera, RefusesOtherMatrices) {
  double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -2, 0.1, 0, -1, 0};
  Camera c;
  EXPECT_EQ(Camera::from_projection(m, 10, 10, {}, &c).code(), StatusCode::kInvalidInput);
  m[12] = 0;
  m[0] = std::nan("");
  EXPECT_FALSE(Camera::from_projection(m, 10, 10, {}, &c).ok());
}

}  // namespace
}  // namespace obscura
