#include "view/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace obscura::view {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Plane {
  double nx, ny, nz, distance;  // n.p = -distance in eye space, n towards the camera

  // Depth along the ray of pixel (x, y); +inf where the plane is not met.
  double depth(const Camera& c, int x, int y) const {
    const double a = (x + 0.5 - c.center_u) * c.scale_x, b = (c.center_v - y - 0.5) * c.scale_y;
    const double d =
        c.orthographic ? (nx * a + ny * b + distance) / nz : -distance / (nx * a + ny * b - nz);
    return d > 0 ? d : INFINITY;
  }
};

Plane tilted(double angle, double azimuth, double distance) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle),
          distance};
}

std::vector<float> render(const Plane& plane, const Camera& camera, int w, int h) {
  std::vector<float> depth(w * h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) depth[y * w + x] = static_cast<float>(plane.depth(camera, x, y));
  }
  return depth;
}

class GeometryTest : public testing::Test {
 protected:
  Status run(const DepthField& field,
             const Needs& needs = {.normals = true, .works_without_normals = true}) {
    return convert(field, needs, *executor_, &geometry_);
  }
  std::unique_ptr<Executor> executor_ = make_executor(2);
  Geometry geometry_;
};

TEST_F(GeometryTest, NormalsOfTiltedPlanesAreExact) {
  const int w = 33, h = 21;
  Camera off_centre = Camera::perspective(1.0f, w, h);
  off_centre.center_u = -10;
  off_centre.scale_x *= 1.5f;
  for (const Camera& camera :
       {Camera::perspective(1.0f, w, h), off_centre, Camera::orthographic_height(4, w, h)}) {
    for (double angle : {0.0, 0.3, 0.9}) {
      for (double azimuth : {0.0, 1.0, 2.5, 4.0}) {
        const Plane plane = tilted(angle, azimuth, 5);
        const auto depth = render(plane, camera, w, h);
        ASSERT_TRUE(run({.depth = {depth.data(), w, h}, .camera = camera}).ok());
        for (int y = 0; y < h; ++y) {
          for (int x = 0; x < w; ++x) {
            if (!(depth[y * w + x] < 100)) continue;
            EXPECT_NEAR(geometry_.normal_x(x, y), plane.nx, 2e-3) << angle << " " << azimuth;
            EXPECT_NEAR(geometry_.normal_y(x, y), plane.ny, 2e-3);
            EXPECT_NEAR(geometry_.normal_z(x, y), plane.nz, 2e-3);
          }
        }
      }
    }
  }
}

TEST_F(GeometryTest, NormalsStayOnTheirSideOfAnEdge) {
  // A near plane left of column 4 and a far one right of it, both facing the camera.
  const int w = 8, h = 5;
  std::vector<float> depth(w * h);
  for (int i = 0; i < w * h; ++i) depth[i] = i % w < 4 ? 1.0f : 9.0f;
  ASSERT_TRUE(run({.depth = {depth.data(), w, h}, .camera = Camera::perspective(1, w, h)}).ok());
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) EXPECT_FLOAT_EQ(geometry_.normal_z(x, y), 1) << x << " " << y;
  }
}

TEST_F(GeometryTest, EveryDepthKindGivesTheSameDepth) {
  const int w = 12, h = 7;
  const float n = 0.5f, f = 40;
  for (const Camera& camera :
       {Camera::perspective(1.2f, w, h), Camera::orthographic_height(4, w, h)}) {
    std::vector<float> linear(w * h), along(w * h), ndc(w * h), reversed(w * h);
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        const int i = y * w + x;
        const double d = 1 + 0.37 * i;
        const double a = (x + 0.5 - camera.center_u) * camera.scale_x;
        const double b = (camera.center_v - y - 0.5) * camera.scale_y;
        linear[i] = static_cast<float>(d);
        along[i] = static_cast<float>(camera.orthographic ? d : d * std::sqrt(1 + a * a + b * b));
        const double z = camera.orthographic ? (d - n) / (f - n) : f * (d - n) / (d * (f - n));
        ndc[i] = static_cast<float>(z);
        reversed[i] = static_cast<float>(1 - z);
      }
    }
    auto depths = [&](const std::vector<float>& values, DepthKind kind) {
      EXPECT_TRUE(run({.depth = {values.data(), w, h},
                       .depth_kind = kind,
                       .near_plane = n,
                       .far_plane = f,
                       .camera = camera})
                      .ok());
      std::vector<float> out;
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) out.push_back(geometry_.depth(x, y));
      }
      return out;
    };
    const auto a = depths(along, DepthKind::kDistance), b = depths(ndc, DepthKind::kNdc),
               c = depths(reversed, DepthKind::kNdcReversed);
    for (int i = 0; i < w * h; ++i) {
      EXPECT_NEAR(a[i], linear[i], 1e-5 * linear[i]);
      EXPECT_NEAR(b[i], linear[i], 1e-4 * linear[i]);
      EXPECT_NEAR(c[i], linear[i], 1e-4 * linear[i]);
    }
  }
}

TEST_F(GeometryTest, InfiniteFarPlane) {
  const std::vector<float> reversed{0.5f, 0.01f, 0, 1};
  ASSERT_TRUE(run({.depth = {reversed.data(), 4, 1},
                   .depth_kind = DepthKind::kNdcReversed,
                   .near_plane = 0.1f,
                   .camera = Camera::perspective(1, 4, 1)})
                  .ok());
  EXPECT_FLOAT_EQ(geometry_.depth(0, 0), 0.2f);
  EXPECT_FLOAT_EQ(geometry_.depth(1, 0), 10);
  EXPECT_EQ(geometry_.depth(2, 0), kInf);
  EXPECT_FLOAT_EQ(geometry_.depth(3, 0), 0.1f);
}

TEST_F(GeometryTest, BackgroundIsInfinityNanOrFar) {
  const std::vector<float> depth{1, kNan, kInf, 50, 49};
  ASSERT_TRUE(
      run({.depth = {depth.data(), 5, 1}, .far_plane = 50, .camera = Camera::perspective(1, 5, 1)})
          .ok());
  EXPECT_EQ(geometry_.depth(0, 0), 1);
  for (int x : {1, 2, 3}) EXPECT_EQ(geometry_.depth(x, 0), kInf);
  EXPECT_EQ(geometry_.depth(4, 0), 49);
  EXPECT_EQ(geometry_.min_depth, 1);
  EXPECT_EQ(geometry_.max_depth, 49);
}

TEST_F(GeometryTest, AllBackground) {
  const std::vector<float> depth(6, kInf);
  ASSERT_TRUE(run({.depth = {depth.data(), 3, 2}, .camera = Camera::perspective(1, 3, 2)}).ok());
  EXPECT_EQ(geometry_.min_depth, 0);
  EXPECT_EQ(geometry_.max_depth, 0);
}

TEST_F(GeometryTest, DepthsThatNoSurfaceCanHaveAreNamed) {
  for (float bad : {0.0f, -1.0f, -kInf}) {
    std::vector<float> depth(12, 2);
    depth[7] = bad;
    const Status s = run({.depth = {depth.data(), 4, 3}, .camera = Camera::perspective(1, 4, 3)});
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find("(3, 1)"), std::string::npos) << s.message();
  }
  for (float bad : {-0.1f, 1.1f, -kInf}) {
    const Status s = run({.depth = {&bad, 1, 1},
                          .depth_kind = DepthKind::kNdcReversed,
                          .near_plane = 1,
                          .camera = Camera::perspective(1, 1, 1)});
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput) << bad;
  }
}

TEST_F(GeometryTest, GivenNormalsAreMadeUnitAndHolesAreFilledFromDepth) {
  std::vector<float> depth(3, 2), x{0, 0, kNan}, y{0, 3, 0}, z{0, 4, 1};
  DepthField field{.depth = {depth.data(), 3, 1}, .camera = Camera::perspective(1, 3, 1)};
  field.normals = {{x.data(), 3, 1}, {y.data(), 3, 1}, {z.data(), 3, 1}};
  ASSERT_TRUE(run(field).ok());
  EXPECT_FLOAT_EQ(geometry_.normal_y(1, 0), 0.6f);
  EXPECT_FLOAT_EQ(geometry_.normal_z(1, 0), 0.8f);
  for (int i : {0, 2}) EXPECT_FLOAT_EQ(geometry_.normal_z(i, 0), 1);
}

TEST_F(GeometryTest, InterleavedAndStridedViewsAreRead) {
  const std::vector<float> rgb{1, 2, 3, 4, 5, 6};
  ASSERT_TRUE(run({.depth = ImageView<const float>(rgb.data() + 1, 2, 1, 6, 3),
                   .camera = Camera::perspective(1, 2, 1)})
                  .ok());
  EXPECT_EQ(geometry_.depth(0, 0), 2);
  EXPECT_EQ(geometry_.depth(1, 0), 5);
}

TEST_F(GeometryTest, WrongShapesAreNamed) {
  const std::vector<float> depth(12, 2), other(6, 2);
  DepthField good{.depth = {depth.data(), 4, 3}, .camera = Camera::perspective(1, 4, 3)};
  EXPECT_TRUE(run(good).ok());
  EXPECT_FALSE(run({}).ok());
  auto message = [&](DepthField f, Needs needs = {.normals = true, .works_without_normals = true}) {
    const Status s = run(f, needs);
    EXPECT_FALSE(s.ok());
    return s.message();
  };
  DepthField f = good;
  f.guard_band = GuardBand::symmetric(2, 1);
  EXPECT_NE(message(f).find("guard_band"), std::string::npos);
  f = good;
  f.camera.scale_x = 0;
  EXPECT_NE(message(f).find("camera"), std::string::npos);
  f = good;
  f.normals =
      VectorView<const float>({other.data(), 3, 2}, {other.data(), 3, 2}, {other.data(), 3, 2});
  EXPECT_NE(message(f).find("normals is 3x2; it must be 4x3"), std::string::npos);
  f = good;
  f.depth_kind = DepthKind::kNdc;
  EXPECT_NE(message(f).find("near_plane"), std::string::npos);
  f.near_plane = 3;
  f.far_plane = 2;
  EXPECT_NE(message(f).find("far_plane"), std::string::npos);
  EXPECT_NE(message(good, {.back_depth = true}).find("back_depth"), std::string::npos);
  EXPECT_NE(message(good, {.layers = 2}).find("layers"), std::string::npos);
}

TEST_F(GeometryTest, BackDepthIsNeverInFrontOfItsSurface) {
  const std::vector<float> depth{2, 2, kInf}, back{3, 1, 4};
  DepthField f{.depth = {depth.data(), 3, 1}, .camera = Camera::perspective(1, 3, 1)};
  f.back_depth = {back.data(), 3, 1};
  ASSERT_TRUE(run(f, {.back_depth = true}).ok());
  EXPECT_EQ(geometry_.back_depth(0, 0), 3);
  EXPECT_EQ(geometry_.back_depth(1, 0), 2);
}

}  // namespace
}  // namespace obscura::view
