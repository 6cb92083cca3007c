#include "obscura/hemisphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "obscura/estimator.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kHalfPi = 1.57079633f;

// An image, its normals and everything the method gives.
struct Picture {
  Picture(int w, int h, bool orthographic)
      : width(w),
        height(h),
        depth(w * h),
        normals(3 * w * h),
        visibility(w * h),
        angle(w * h),
        bent(3 * w * h),
        uniform(3 * w * h),
        cosine(3 * w * h) {
    field.camera =
        orthographic ? Camera::orthographic_height(2, w, h) : Camera::perspective(1.0f, w, h);
    field.depth = ImageView<const float>(depth.data(), w, h);
    field.normals = VectorView<float>::interleaved(normals.data(), w, h);
  }
  // Fills with the plane n.(p - (0, 0, -distance)) = 0.
  void plane(double nx, double ny, double nz, double distance) {
    const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
    const Camera& c = field.camera;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double a = (x + 0.5 - c.center_u) * c.scale_x, b = (c.center_v - y - 0.5) * c.scale_y;
        const double z = c.orthographic ? distance + (nx * a + ny * b) / nz
                                        : distance * nz / (nz - nx * a - ny * b);
        depth[y * width + x] = static_cast<float>(z);
        set_normal(x, y, nx / length, ny / length, nz / length);
      }
    }
  }
  void set_normal(int x, int y, double nx, double ny, double nz) {
    float* n = &normals[3 * (y * width + x)];
    n[0] = float(nx), n[1] = float(ny), n[2] = float(nz);
  }
  Status run(const HemisphereSettings& s, int threads = 0) {
    Outputs o;
    o.visibility = ImageView<float>(visibility.data(), width, height);
    o.cone_angle = ImageView<float>(angle.data(), width, height);
    o.bent_normal = VectorView<float>::interleaved(bent.data(), width, height);
    o.uniform_integral = VectorView<float>::interleaved(uniform.data(), width, height);
    o.cosine_integral = VectorView<float>::interleaved(cosine.data(), width, height);
    const auto executor = make_executor(threads);
    return compute(field, s, o, {.executor = executor.get()});
  }

  int width, height;
  std::vector<float> depth, normals, visibility, angle, bent, uniform, cosine;
  DepthField field;
};

TEST(Hemisphere, PlanesOfAnyTiltAreOpenExactly) {
  const double tilts[][3] = {{0, 0, 1}, {0.7, 0, 0.7}, {-0.3, 0.5, 0.6}, {0.1, -0.2, 0.97}};
  for (bool orthographic : {false, true}) {
    for (const auto& n : tilts) {
      for (int steps : {0, 3}) {
        Picture p(61, 40, orthographic);
        p.plane(n[0], n[1], n[2], 5);
        ASSERT_TRUE(
            p.run({.falloff = {.kind = FalloffKind::kConstant, .radius = 0.5f}, .steps = steps})
                .ok());
        for (int i = 0; i < p.width * p.height; ++i) {
          ASSERT_NEAR(p.visibility[i], 1, 1e-6) << n[0];
          ASSERT_NEAR(p.angle[i], kHalfPi, 2e-3);
          for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(p.bent[3 * i + k], p.normals[3 * i + k], 1e-5);
            ASSERT_NEAR(p.uniform[3 * i + k], p.normals[3 * i + k], 1e-5);
            ASSERT_NEAR(p.cosine[3 * i + k], p.normals[3 * i + k] * 2 / 3, 1e-5);
          }
        }
      }
    }
  }
}

// A wall of endless height beside a floor seen from above: next to it half the hemisphere is
// blocked. Uniform and cosine-weighted visibility are 1/2; the mean direction of a quarter sphere
// is (1/2, 0, 1/2); the cosine-weighted integral is 1/pi integral of w (n.w), (2/(3 pi), 0, 1/3).
TEST(Hemisphere, BesideAWallHalfIsOpen) {
  Picture p(64, 64, true);
  p.plane(0, 0, 1, 50);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) p.depth[y * 64 + x] = 1;
  }
  for (RayWeighting weighting : {RayWeighting::kUniform, RayWeighting::kCosine}) {
    ASSERT_TRUE(p.run({.falloff = {.kind = FalloffKind::kConstant, .radius = 0.9f},
                       .samples = 64,
                       .steps = 8,
                       .interleave = 2,
                       .weighting = weighting})
                    .ok());

    const int i = 32 * 64 + 32;
    EXPECT_NEAR(p.visibility[i], 0.5, 0.03);
    const double length = std::sqrt(0.5);
    EXPECT_NEAR(p.bent[3 * i], 0.5 / length, 0.06);
    EXPECT_NEAR(p.bent[3 * i + 1], 0, 0.06);
    EXPECT_NEAR(p.bent[3 * i + 2], 0.5 / length, 0.06);
    EXPECT_NEAR(p.angle[i], std::acos(2 * length - 1), 0.08);
    EXPECT_NEAR(p.cosine[3 * i], 2 / (3 * std::numbers::pi), 0.03);
    EXPECT_NEAR(p.cosine[3 * i + 2], 1.0 / 3, 0.03);
  }
}

// At the bottom of a round shaft of endless height and radius r a direction is blocked where its
// last point, at t in [(8/9)^2 R, R], is beyond the shaft: a cap with sin(alpha) = r/t. Its
// cosine-weighted visibility sin^2(alpha) is r^2/R^2 times the mean of (R/t)^2, 1.2714.
TEST(Hemisphere, CapsAreFoundAtTheBottomOfAShaft) {
  Picture p(96, 96, true);
  p.field.camera = Camera::orthographic_height(9.6f, 96, 96);
  p.plane(0, 0, 1, 20);
  const double radius = 3.0, reach = 4.7;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (std::hypot(x - 47.5, y - 47.5) * 0.1 > radius) p.depth[y * 96 + x] = 1;
    }
  }
  ASSERT_TRUE(p.run({.falloff = {.kind = FalloffKind::kConstant, .radius = float(reach)},
                     .samples = 64,
                     .steps = 8,
                     .interleave = 2})
                  .ok());
  const int i = 48 * 96 + 48;
  const double square = 1.2714 * radius * radius / (reach * reach);
  EXPECT_NEAR(p.visibility[i], square, 0.02);
  EXPECT_NEAR(p.angle[i], std::asin(std::sqrt(square)), 0.02);
  EXPECT_NEAR(p.bent[3 * i + 2], 1, 2e-3);
}

TEST(Hemisphere, BackgroundAndItsNeighboursAreDefined) {
  Picture p(33, 21, false);
  p.plane(0, 0, 1, 5);
  for (int i = 0; i < 33 * 21; i += 3) p.depth[i] = kInf;
  p.set_normal(1, 0, 0, 0, 0);
  ASSERT_TRUE(p.run({}).ok());
  for (int i = 0; i < 33 * 21; ++i) {
    ASSERT_TRUE(p.visibility[i] >= 0 && p.visibility[i] <= 1);
    ASSERT_TRUE(p.angle[i] >= 0 && p.angle[i] <= kHalfPi);
    double square = 0;
    for (int k = 0; k < 3; ++k) square += double{p.bent[3 * i + k]} * p.bent[3 * i + k];
    ASSERT_NEAR(square, 1, 1e-4);
  }
  EXPECT_EQ(p.visibility[0], 1);
}

TEST(Hemisphere, ThinOccludersLetLightPassBehindThem) {
  Picture p(64, 64, true);
  p.plane(0, 0, 1, 50);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) p.depth[y * 64 + x] = 49;
  }
  const HemisphereSettings solid{.falloff = {.kind = FalloffKind::kConstant, .radius = 2},
                                 .occluder = Occluder::solid()};
  HemisphereSettings thin = solid;
  thin.occluder = Occluder::of_thickness(0.05f);
  ASSERT_TRUE(p.run(solid).ok());
  const float with_solid = p.visibility[32 * 64 + 33];
  ASSERT_TRUE(p.run(thin).ok());
  const float with_thin = p.visibility[32 * 64 + 33];
  EXPECT_GT(with_thin, with_solid + 0.1f);
  // The same matter as an image of where it ends.
  std::vector<float> back = p.depth;
  for (float& b : back) b += 0.05f;
  p.field.back_depth = {back.data(), 64, 64};
  thin.occluder = Occluder::back_depth();
  ASSERT_TRUE(p.run(thin).ok());
  EXPECT_NEAR(p.visibility[32 * 64 + 33], with_thin, 1e-6);
  thin.occluder = Occluder::automatic();
  ASSERT_TRUE(p.run(thin).ok());
  EXPECT_NEAR(p.visibility[32 * 64 + 33], with_thin, 1e-6);
  p.field.back_depth = {};
  thin.occluder = Occluder::back_depth();
  EXPECT_NE(p.run(thin).message().find("back_depth is missing"), std::string::npos);
  thin.occluder = Occluder::of_layers(2);
  EXPECT_NE(p.run(thin).message().find("hemisphere takes"), std::string::npos);
  EXPECT_NE(p.run({.falloff = {.kind = FalloffKind::kExponential}})
                .message()
                .find("hemisphere takes constant or quadratic"),
            std::string::npos);
}

TEST(Hemisphere, BitsDoNotDependOnThreads) {
  Picture a(70, 50, false), b(70, 50, false);
  for (Picture* p : {&a, &b}) {
    p->plane(0.2, 0.3, 0.9, 4);
    for (int i = 0; i < 70 * 50; i += 7) p->depth[i] -= 0.2f;
  }
  ASSERT_TRUE(a.run({}, 1).ok());
  ASSERT_TRUE(b.run({}, 3).ok());
  EXPECT_EQ(a.visibility, b.visibility);
  EXPECT_EQ(a.bent, b.bent);
  EXPECT_EQ(a.cosine, b.cosine);
}

// Constant light gives visibility times the light; beside a wall on the left, light from the right
// arrives in full.
TEST(Hemisphere, DirectionsGatherTheirLight) {
  Picture p(64, 64, true);
  p.plane(0, 0, 1, 50);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 32; ++x) p.depth[y * 64 + x] = 1;
  }
  HemisphereSettings s{
      .falloff = {.kind = FalloffKind::kConstant, .radius = 0.9f}, .samples = 32, .steps = 4};
  s.radiance = [](const std::array<float, 3>& w) {
    return std::array<float, 3>{2, w[0] > 0 ? 2.0f : 0.0f, 1 + w[0]};
  };
  std::vector<float> rgb(3 * 64 * 64);
  Outputs o;
  o.visibility = ImageView<float>(p.visibility.data(), 64, 64);
  o.cosine_integral = VectorView<float>::interleaved(p.cosine.data(), 64, 64);
  o.radiance = VectorView<float>::interleaved(rgb.data(), 64, 64);
  ASSERT_TRUE(compute(p.field, s, o).ok());
  for (int i = 0; i < 64 * 64; ++i) ASSERT_NEAR(rgb[3 * i], 2 * p.visibility[i], 1e-4);
  const int i = 32 * 64 + 36;
  EXPECT_NEAR(rgb[3 * i + 1], 1, 0.06);
  EXPECT_NEAR(rgb[3 * i + 2], p.visibility[i] + p.cosine[3 * i], 0.04);
  s.radiance = {};
  EXPECT_EQ(compute(p.field, s, o).code(), StatusCode::kUnsupported);
}

TEST(Hemisphere, SettingsAreChecked) {
  Picture p(8, 8, false);
  p.plane(0, 0, 1, 1);
  EXPECT_EQ(p.run({.samples = 0}).message(), "samples is 0; it must be in [1, 64]");
  EXPECT_FALSE(p.run({.steps = 9}).ok());
  EXPECT_FALSE(p.run({.interleave = 0}).ok());
  EXPECT_FALSE(p.run({.falloff = {.kind = FalloffKind::kExponential}}).ok());
  EXPECT_FALSE(p.run({.occluder = Occluder::back_depth()}).ok());
  p.field.normal_use = NormalUse::kNone;
  EXPECT_EQ(p.run({}).code(), StatusCode::kUnsupported);
}

}  // namespace
}  // namespace obscura
