// Properties of the estimators of volumetric obscurance as users call them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

struct Named {
  const char* name;
  MethodSettings settings;
  double plane_tolerance;  // how far from 1 a plane may be
  double half_tolerance;   // how far from 1/2 a facing plane may be without normals; 1: not at all
};

LineSettings line(bool rotate, bool blur, FalloffKind kind) {
  LineSettings s;
  s.falloff = {.kind = kind, .radius = 0.5f};
  s.rotate = rotate;
  s.blur = blur;
  return s;
}

PointSettings point(int samples, bool rotate, FalloffKind kind) {
  PointSettings s;
  s.falloff = {.kind = kind, .radius = 0.5f};
  s.samples = samples;
  s.rotate = rotate;
  s.blur = false;
  return s;
}

AreaSettings area(int samples, bool rotate, FalloffKind kind) {
  AreaSettings s;
  s.falloff = {.kind = kind, .radius = 0.5f};
  s.samples = samples;
  s.rotate = rotate;
  return s;
}

std::vector<Named> methods() {
  LineSettings tangent = line(true, false, FalloffKind::kConstant);
  tangent.sphere = SphereKind::kTangent;
  LineSettings dual = line(true, true, FalloffKind::kConstant);
  dual.dual.second_radius = 0.2f;
  dual.dual.combine = Combine::kMinimum;
  PointSettings screen = point(12, true, FalloffKind::kConstant);
  screen.pattern = PointPattern::kScreen;
  return {
      {"line", line(true, true, FalloffKind::kConstant), 0.005, 1e-6},
      {"line, fixed", line(false, false, FalloffKind::kConstant), 0.005, 1e-6},
      {"line, quadratic", line(true, false, FalloffKind::kQuadratic), 0.005, 1e-6},
      {"line, tangent", tangent, 0.005, 1},
      {"line, dual", dual, 0.005, 1e-6},
      // A plane occludes no sample at all; without normals, half of the ball is met by chance.
      {"point", point(12, true, FalloffKind::kConstant), 1e-6, 0.25},
      {"point, fixed", point(33, false, FalloffKind::kConstant), 1e-6, 0.1},
      {"point, quadratic", point(7, true, FalloffKind::kQuadratic), 1e-6, 0.3},
      {"point, screen", screen, 1e-6, 1},
      {"area", area(1, true, FalloffKind::kConstant), 0.005, 1e-3},
      {"area, 9 fixed", area(9, false, FalloffKind::kConstant), 0.005, 1e-3},
      {"area, quadratic", area(4, true, FalloffKind::kQuadratic), 0.005, 2e-3},
  };
}

bool takes_thickness(const Named& m) { return std::string(m.name) != "point, screen"; }

// Every volumetric method takes one; some others do not.
void set_occluder(const Occluder& occluder, MethodSettings* settings) {
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.occluder; }) s.occluder = occluder;
      },
      *settings);
}

Falloff& falloff_of(MethodSettings* settings) {
  return std::visit([](auto& s) -> Falloff& { return s.falloff; }, *settings);
}

std::vector<float> visibility(const synthetic::Input& in, const MethodSettings& settings,
                              int threads = 1, NormalUse normals = NormalUse::kAuto) {
  std::vector<float> result(static_cast<std::size_t>(in.visible().width) * in.visible().height,
                            -1.0f);
  Estimator estimator;
  Status status = Estimator::create(settings, in.width, in.height, &estimator);
  EXPECT_TRUE(status.ok()) << status.message();
  DepthField field = in.field();
  field.normal_use = normals;
  const ImageView<float> out(result.data(), in.visible().width, in.visible().height);
  status = estimator.run(field, {.visibility = out}, {.threads = threads});
  EXPECT_TRUE(status.ok()) << status.message();
  return result;
}

TEST(Volumetric, TiltedPlanesAreOpen) {
  Random random(1);
  for (const Named& m : methods()) {
    for (int i = 0; i < 24; ++i) {
      const int width = 70, height = 50;
      const Camera camera = synthetic::random_camera(width, height, i % 2 != 0, &random);
      // Up to 70 degrees from the axis, in any direction.
      const double tilt = 70 * random.uniform() * M_PI / 180, turn = 2 * M_PI * random.uniform();
      synthetic::Input in = synthetic::plane(width, height, camera, std::sin(tilt) * std::cos(turn),
                                             std::sin(tilt) * std::sin(turn), std::cos(tilt), 6);
      if (i % 3 == 0) in.normals.clear();
      if (i % 4 == 1) in.guard_band = {9, 3, 5, 7};
      const std::vector<float> v = visibility(in, m.settings);
      // Not where the sphere reaches behind the camera, and not where float precision is a
      // hundredth of the sphere.
      double worst = 0;
      for (std::size_t k = 0; k < v.size(); ++k) {
        const std::size_t x = k % in.visible().width + in.guard_band.left;
        const std::size_t y = k / in.visible().width + in.guard_band.top;
        const float z = in.depth[y * width + x];
        if (z > 0.5f && z < 1000) worst = std::max(worst, std::abs(1.0 - v[k]));
      }
      EXPECT_LE(worst, m.plane_tolerance) << m.name << ", plane " << i;
    }
  }
}

// Seen straight on and without normals half of the sphere is free.
TEST(Volumetric, FacingPlaneWithoutNormalsIsHalf) {
  const Camera camera = Camera::perspective(0.8f, 64, 48);
  const synthetic::Input in = synthetic::plane(64, 48, camera, 0, 0, 1, 4);
  for (const Named& m : methods()) {
    if (m.half_tolerance == 1) continue;
    for (const float v : visibility(in, m.settings, 1, NormalUse::kNone)) {
      EXPECT_NEAR(v, 0.5f, m.half_tolerance) << m.name;
    }
  }
}

TEST(Volumetric, AnyNumberOfThreadsGivesTheSameBits) {
  synthetic::Input in = synthetic::blocks(133, 77, Camera::perspective(0.8f, 133, 77), 2);
  in.guard_band = {8, 4, 2, 6};
  for (const Named& m : methods()) {
    const std::vector<float> one = visibility(in, m.settings, 1);
    for (const int threads : {2, 3}) {
      const std::vector<float> more = visibility(in, m.settings, threads);
      EXPECT_EQ(std::memcmp(one.data(), more.data(), one.size() * sizeof(float)), 0)
          << m.name << ", " << threads << " threads";
    }
  }
}

TEST(Volumetric, EverySizeWorks) {
  for (const Named& m : methods()) {
    for (const auto& [w, h] :
         {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {17, 3}, {15, 16}, {65, 5}}) {
      const synthetic::Input in = synthetic::blocks(w, h, Camera::perspective(0.8f, w, h), 3);
      for (const float v : visibility(in, m.settings)) {
        EXPECT_TRUE(v >= 0 && v <= 1) << m.name << ", " << w << "x" << h << ": " << v;
      }
    }
  }
}

TEST(Volumetric, NothingButBackgroundIsOpen) {
  synthetic::Input in = synthetic::blocks(40, 30, Camera::perspective(0.8f, 40, 30), 4);
  for (const float background : {kInf, std::nanf("")}) {
    std::fill(in.depth.begin(), in.depth.end(), background);
    for (const Named& m : methods()) {
      for (const float v : visibility(in, m.settings)) EXPECT_EQ(v, 1.0f) << m.name;
    }
  }
}

// A single pixel in front of nothing sees at least the half towards the camera.
TEST(Volumetric, LonePixelIsOpen) {
  synthetic::Input in = synthetic::blocks(31, 31, Camera::perspective(0.8f, 31, 31), 5);
  std::fill(in.depth.begin(), in.depth.end(), kInf);
  in.depth[15 * 31 + 15] = 4;
  for (const Named& m : methods()) {
    EXPECT_NEAR(visibility(in, m.settings)[15 * 31 + 15], 1, 1e-6) << m.name;
  }
}

TEST(Volumetric, ExtremeRadiiAndDepthsGiveNumbers) {
  synthetic::Input in = synthetic::blocks(45, 33, Camera::perspective(0.8f, 45, 33), 6);
  for (Named m : methods()) {
    for (const float radius : {1e-42f, 1e-30f, 1e-6f, 1e6f, 1e30f, 3e38f}) {
      falloff_of(&m.settings).radius = radius;
      for (const float scale : {1e-36f, 1.0f, 1e37f}) {
        synthetic::Input scaled = in;
        for (float& z : scaled.depth) z *= scale;
        for (const float v : visibility(scaled, m.settings)) {
          ASSERT_TRUE(v >= 0 && v <= 1) << m.name << ", radius " << radius << ", depth x " << scale;
        }
      }
    }
  }
}

TEST(Volumetric, WrongRadiusIsRefused) {
  for (Named m : methods()) {
    for (const float radius : {0.0f, -1.0f, std::nanf(""), kInf, -kInf}) {
      falloff_of(&m.settings).radius = radius;
      Estimator estimator;
      const Status s = Estimator::create(m.settings, 10, 10, &estimator);
      EXPECT_EQ(s.code(), StatusCode::kInvalidArgument) << m.name;
      EXPECT_NE(s.message().find("radius is"), std::string::npos) << s.message();
    }
  }
}

TEST(Volumetric, OtherFalloffsAreRefused) {
  for (Named m : methods()) {
    for (const FalloffKind kind : {FalloffKind::kExponential, FalloffKind::kInverseSquare,
                                   FalloffKind::kTable, FalloffKind::kFunction}) {
      Falloff& f = falloff_of(&m.settings);
      f.kind = kind;
      f.table = {1, 0};
      f.function = [](float) { return 1.0f; };
      Estimator estimator;
      const Status s = Estimator::create(m.settings, 10, 10, &estimator);
      EXPECT_EQ(s.code(), StatusCode::kInvalidArgument) << m.name;
      EXPECT_NE(s.message().find("constant or quadratic"), std::string::npos) << s.message();
    }
  }
}

TEST(Volumetric, OtherOccludersAreRefused) {
  for (Named m : methods()) {
    for (const Occluder& o : {Occluder::back_depth(), Occluder::of_layers(2),
                              Occluder::of_thickness(-1), Occluder::of_thickness(kInf)}) {
      set_occluder(o, &m.settings);
      Estimator estimator;
      const Status s = Estimator::create(m.settings, 10, 10, &estimator);
      EXPECT_EQ(s.code(), StatusCode::kInvalidArgument) << m.name;
      EXPECT_NE(s.message().find("occluder"), std::string::npos) << s.message();
    }
  }
}

// A thin object occludes no more than a solid one, and an object thicker than the sphere as much.
TEST(Volumetric, ThicknessLiesBetweenOpenAndSolid) {
  const synthetic::Input in = synthetic::blocks(80, 60, Camera::perspective(0.8f, 80, 60), 7);
  for (Named m : methods()) {
    if (!takes_thickness(m)) continue;
    const std::vector<float> solid = visibility(in, m.settings);
    std::vector<float> thinner = std::vector<float>(solid.size(), 1.0f);
    for (const float thickness : {0.05f, 0.2f, 0.6f, 50.0f}) {
      set_occluder(Occluder::of_thickness(thickness), &m.settings);
      const std::vector<float> v = visibility(in, m.settings);
      for (std::size_t i = 0; i < v.size(); ++i) {
        ASSERT_LE(v[i], thinner[i] + 1e-5f) << m.name << ", thickness " << thickness;
        ASSERT_GE(v[i], solid[i] - 1e-5f) << m.name << ", thickness " << thickness;
      }
      thinner = v;
    }
    for (std::size_t i = 0; i < solid.size(); ++i) ASSERT_NEAR(thinner[i], solid[i], 1e-5f);
  }
}

// Outputs of any stride, and only where they are asked for.
TEST(Volumetric, StridedOutput) {
  const synthetic::Input in = synthetic::blocks(50, 20, Camera::perspective(0.8f, 50, 20), 8);
  for (const Named& m : methods()) {
    const std::vector<float> expected = visibility(in, m.settings);
    std::vector<float> pixels(3 * 60 * 20, -7.0f);
    const ImageView<float> out(pixels.data() + 1, 50, 20, 3 * 60, 3);
    ASSERT_TRUE(compute(in.field(), m.settings, {.visibility = out}).ok());
    for (int i = 0; i < 60 * 20; ++i) {
      const int x = i % 60, y = i / 60;
      EXPECT_EQ(pixels[3 * i], -7.0f);
      EXPECT_EQ(pixels[3 * i + 1], x < 50 ? expected[y * 50 + x] : -7.0f);
    }
  }
}

TEST(Volumetric, MistakesAreNamed) {
  auto message = [](const MethodSettings& settings) {
    Estimator estimator;
    const Status s = Estimator::create(settings, 10, 10, &estimator);
    EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
    return s.message();
  };
  LineSettings l;
  l.samples = 0;
  EXPECT_EQ(message(l), "samples is 0; it must be in [1, 32]");
  l = {};
  l.dual.second_radius = 0.0f;
  EXPECT_EQ(message(l), "second_radius is 0; it must be in (0, inf), or none");
  l.dual.second_radius = -2.0f;
  EXPECT_EQ(message(l), "second_radius is -2; it must be in (0, inf), or none");
  l = {};
  l.occluder = Occluder::of_thickness(-1);
  EXPECT_EQ(message(l), "occluder thickness is -1; it must be in (0, inf)");
  PointSettings p;
  p.samples = 65;
  EXPECT_EQ(message(p), "samples is 65; it must be in [1, 64]");
  AreaSettings a;
  a.samples = 17;
  EXPECT_EQ(message(a), "samples is 17; it must be in [1, 16]");
  p.samples = 33;
  p.pattern = PointPattern::kScreen;
  EXPECT_EQ(message(p), "samples is 33; the screen pattern has sizes in [1, 32]");
}

TEST(Volumetric, TangentSphereNeedsNormals) {
  const synthetic::Input in = synthetic::blocks(10, 10, Camera::perspective(0.8f, 10, 10), 1);
  LineSettings s;
  s.sphere = SphereKind::kTangent;
  DepthField field = in.field();
  field.normal_use = NormalUse::kNone;
  std::vector<float> out(100, -1.0f);
  const Status status = compute(field, s, {.visibility = {out.data(), 10, 10}});
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(out, std::vector<float>(100, -1.0f));
}

// The product of two radii is the product of each alone; the minimum likewise.
TEST(Volumetric, DualRadiiCombine) {
  const synthetic::Input in = synthetic::blocks(40, 30, Camera::perspective(0.8f, 40, 30), 9);
  LineSettings one = line(true, false, FalloffKind::kConstant), two = one, both = one;
  two.falloff.radius = 0.2f;
  both.dual.second_radius = 0.2f;
  const std::vector<float> a = visibility(in, one), b = visibility(in, two);
  const std::vector<float> product = visibility(in, both);
  both.dual.combine = Combine::kMinimum;
  const std::vector<float> minimum = visibility(in, both);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(product[i], a[i] * b[i]);
    EXPECT_EQ(minimum[i], std::min(a[i], b[i]));
  }
}

// Many lines and many points estimate the same integral.
TEST(Volumetric, LinesAndPointsAgree) {
  const synthetic::Input in = synthetic::blocks(90, 70, Camera::perspective(0.8f, 90, 70), 10);
  for (const NormalUse normals : {NormalUse::kAuto, NormalUse::kNone}) {
    for (const bool thin : {false, true}) {
      LineSettings l = line(true, false, FalloffKind::kConstant);
      PointSettings p = point(64, true, FalloffKind::kConstant);
      l.samples = 32;
      if (thin) l.occluder = p.occluder = Occluder::of_thickness(0.2f);
      const std::vector<float> a = visibility(in, l, 1, normals), b = visibility(in, p, 1, normals);
      double sum = 0, bias = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::abs(a[i] - b[i]);
        bias += a[i] - b[i];
      }
      EXPECT_LT(sum / a.size(), 0.03) << "thin " << thin;
      EXPECT_LT(std::abs(bias) / a.size(), 0.01) << "thin " << thin;
    }
  }
}

}  // namespace
}  // namespace obscura
