#include "scene/truth/geometric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura::tools {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kInf = std::numeric_limits<float>::infinity();

Rendering render(const std::string& spec) {
  Rendering r;
  const Status status = load_scene(spec, {}, *make_executor(), &r);
  EXPECT_TRUE(status.ok()) << status.message();
  return r;
}

struct Result {
  explicit Result(const Rendering& r)
      : width(r.view.width),
        height(r.view.height),
        visibility(width * height, -7.0f),
        cone(visibility),
        error(visibility),
        bent(3 * visibility.size(), -7.0f),
        uniform(bent),
        cosine(bent) {}

  Outputs all() {
    Outputs o;
    o.visibility = {visibility.data(), width, height};
    o.cone_angle = {cone.data(), width, height};
    o.standard_error = {error.data(), width, height};
    o.bent_normal = VectorView<float>::interleaved(bent.data(), width, height);
    o.uniform_integral = VectorView<float>::interleaved(uniform.data(), width, height);
    o.cosine_integral = VectorView<float>::interleaved(cosine.data(), width, height);
    return o;
  }
  Outputs only_visibility() {
    Outputs o;
    o.visibility = {visibility.data(), width, height};
    return o;
  }

  int width, height;
  std::vector<float> visibility, cone, error, bent, uniform, cosine;
};

GeometricSettings endless(int rays, RayWeighting weighting = RayWeighting::kCosine) {
  GeometricSettings s;
  s.falloff.radius = kInf;
  s.rays = rays;
  s.weighting = weighting;
  return s;
}

struct Deviation {
  double bias = 0, rms = 0;
  int count = 0;
};

// Against a closed form over eye-space points and normals; NaN leaves a pixel out.
template <class ClosedForm>
Deviation deviation(const Rendering& r, const std::vector<float>& values, ClosedForm closed_form) {
  Deviation d;
  const DepthInput& g = r.gbuffer;
  const Frame frame = r.view.frame();
  for (int y = 0; y < r.view.height; ++y) {
    for (int x = 0; x < r.view.width; ++x) {
      const int u = x + g.guard_band.left, v = y + g.guard_band.top;
      const std::size_t i = std::size_t(v) * g.width + u;
      if (!std::isfinite(g.depth[i])) continue;
      const double away = g.camera.orthographic ? 1 : g.depth[i];
      const Vec3 eye{(u + 0.5 - g.camera.center_u) * g.camera.scale_x * away,
                     (g.camera.center_v - v - 0.5) * g.camera.scale_y * away, -g.depth[i]};
      const Vec3 normal{g.normal_x[i], g.normal_y[i], g.normal_z[i]};
      const double expected = closed_form(r.view.eye + frame.to_world(eye), frame.to_world(normal));
      if (std::isnan(expected)) continue;
      const double error = values[std::size_t(y) * r.view.width + x] - expected;
      d.bias += error;
      d.rms += error * error;
      ++d.count;
    }
  }
  d.bias /= d.count;
  d.rms = std::sqrt(d.rms / d.count);
  return d;
}

// The thresholds for closed forms with 4,096 rays.
constexpr double kBias = 0.001, kRms = 0.005;

void expect_close(const Deviation& d, const std::string& what) {
  EXPECT_GT(d.count, 50) << what;
  EXPECT_LT(std::abs(d.bias), kBias) << what;
  EXPECT_LT(d.rms, kRms) << what;
}

// Notes on the closed form: h r^2 / l^3 on the plane, l from the sphere's centre.
double sphere_over_plane(Vec3 p, Vec3 n) {
  if (n.y < 0.999 || p.y > 0.1) return NAN;
  return 1 - 1.5 / std::pow(length(p - Vec3{0, 1.5, 0}), 3);
}

TEST(Geometric, SphereOverPlane) {
  const Rendering r = render("scene:sphere-over-plane?size=32x18&guard-band=0");
  Result result(r);
  ASSERT_TRUE(trace_geometric(r, endless(4096), result.only_visibility()).ok());
  expect_close(deviation(r, result.visibility, sphere_over_plane), "sphere over plane");
}

// Share of cosine-weighted directions from p that meet a polygon wholly above the horizon
// (Lambert): corners clockwise seen from p.
double form_factor(Vec3 p, Vec3 n, const std::vector<Vec3>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = normalize(corners[i] - p), b = normalize(corners[(i + 1) % corners.size()] - p);
    const Vec3 c = cross(a, b);
    sum += std::atan2(length(c), dot(a, b)) * dot(n, normalize(c));
  }
  return std::abs(sum) / (2 * kPi);
}

TEST(Geometric, GrooveOfTwoWalls) {
  constexpr double kReach = 40;  // the walls' length, and half the groove's
  for (double degrees : {60.0, 90.0, 120.0}) {
    const double angle = degrees * kPi / 180, c = std::cos(angle / 2), h = std::sin(angle / 2);
    const Rendering r =
        render("scene:groove?size=24x14&guard-band=0&angle=" + std::to_string(degrees));
    Result result(r);
    ASSERT_TRUE(trace_geometric(r, endless(4096), result.only_visibility()).ok());
    auto other_wall = [&](Vec3 p, Vec3 n) {
      const double x = p.x < 0 ? h * kReach : -h * kReach, z = c * kReach;
      return 1 -
             form_factor(p, n, {{0, -kReach, 0}, {0, kReach, 0}, {x, kReach, z}, {x, -kReach, z}});
    };
    expect_close(deviation(r, result.visibility, other_wall), "cosine");
  }
}

TEST(Geometric, CornerOfThreeWalls) {
  const Rendering r = render("scene:corner?size=24x14&guard-band=0");
  Result result(r);
  ASSERT_TRUE(trace_geometric(r, endless(4096), result.only_visibility()).ok());
  auto other_walls = [](Vec3 p, Vec3 n) {
    constexpr double kReach = 40;
    double sum = 0;
    const Vec3 axes[] = {{kReach, 0, 0}, {0, kReach, 0}, {0, 0, kReach}};
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = axes[i], b = axes[(i + 1) % 3];
      if (dot(n, a) + dot(n, b) < 1) continue;  // the receiver's own wall
      sum += form_factor(p, n, {{}, a, a + b, b});
    }
    return 1 - sum;
  };
  expect_close(deviation(r, result.visibility, other_walls), "corner");
}

TEST(Geometric, InfiniteGrooveAndCornerByBothWeights) {
  struct Case {
    const char* spec;
    double cosine, uniform;
  };
  for (const Case& c :
       {Case{"scene:groove?size=12x8&guard-band=0&reach=2000&angle=60", 0.25, 1.0 / 3},
        Case{"scene:corner?size=12x8&guard-band=0&reach=2000", 0.25, 0.25}}) {
    const Rendering r = render(c.spec);
    Result result(r);
    for (RayWeighting weighting : {RayWeighting::kCosine, RayWeighting::kUniform}) {
      GeometricSettings settings = endless(4096, weighting);
      settings.offset = 1e-3;
      ASSERT_TRUE(trace_geometric(r, settings, result.only_visibility()).ok());
      const double expected = weighting == RayWeighting::kCosine ? c.cosine : c.uniform;
      const Deviation d = deviation(r, result.visibility, [&](Vec3, Vec3) { return expected; });
      EXPECT_LT(std::abs(d.bias), 2 * kBias) << c.spec;
      EXPECT_LT(d.rms, kRms) << c.spec;
    }
  }
}

TEST(Geometric, BumpOnAPlane) {
  const Rendering r = render("scene:bump?size=32x18&guard-band=0");
  Result result(r);
  ASSERT_TRUE(trace_geometric(r, endless(4096), result.only_visibility()).ok());
  auto closed_form = [](Vec3 p, Vec3) {
    const double square = p.x * p.x + p.y * p.y;
    if (square < 1.02) return double(NAN);
    const double w = std::sqrt(square - 1);
    return 1 - (std::atan(1 / w) - w / square) / kPi;
  };
  expect_close(deviation(r, result.visibility, closed_form), "bump");
}

// The checks above must be able to fail: uniform instead of cosine weights, and a normal off by
// 2 degrees.
TEST(Geometric, WrongCosineIsNoticed) {
  const Rendering r = render("scene:groove?size=24x14&guard-band=0&angle=60");
  Result result(r);
  ASSERT_TRUE(
      trace_geometric(r, endless(4096, RayWeighting::kUniform), result.only_visibility()).ok());
  const Deviation d = deviation(r, result.visibility, [](Vec3, Vec3) { return 0.25; });
  EXPECT_GT(std::abs(d.bias), 10 * kBias);
  EXPECT_GT(d.rms, kRms);

  Rendering tilted = r;
  for (float& x : tilted.gbuffer.normal_x) x += 0.035f;
  ASSERT_TRUE(trace_geometric(tilted, endless(4096), result.only_visibility()).ok());
  EXPECT_GT(deviation(r, result.visibility, [](Vec3, Vec3) { return 0.25; }).rms, kRms);
}

// In a groove that opens towards the camera the open directions are a lune around +z, whose
// integrals are elementary.
TEST(Geometric, DirectionsInAGroove) {
  const double angle = kPi / 3, s = std::sin(angle);
  const Rendering r = render("scene:groove?size=16x10&guard-band=0&angle=60&reach=2000");
  Result result(r);
  GeometricSettings settings = endless(4096);
  settings.offset = 1e-3;
  ASSERT_TRUE(trace_geometric(r, settings, result.all()).ok());
  const double mean_length = std::sin(angle / 2) / (2 * angle / kPi);
  const double along = 4 / (3 * kPi) * s * s / 2,
               up = 4 / (3 * kPi) * (angle / 2 - std::sin(2 * angle) / 4);
  for (int i = 0; i < result.width * result.height; ++i) {
    EXPECT_NEAR(result.uniform[3 * i], 0, 0.02);
    EXPECT_NEAR(result.uniform[3 * i + 1], 0, 0.02);
    EXPECT_NEAR(result.uniform[3 * i + 2], std::sin(angle / 2), 0.02);
    EXPECT_NEAR(result.bent[3 * i + 2], 1, 0.002);
    EXPECT_NEAR(result.cone[i], std::acos(2 * mean_length - 1), 0.05);
    // The wall's direction from the crease, and its normal.
    const double side = i % result.width < result.width / 2 ? -1 : 1;
    const double c = std::cos(angle / 2), h = std::sin(angle / 2);
    EXPECT_NEAR(result.cosine[3 * i], side * (along * h - up * c), 0.02);
    EXPECT_NEAR(result.cosine[3 * i + 2], along * c + up * h, 0.02);
  }
}

TEST(Geometric, OpenPlaneGivesTheValuesOfAnOpenHemisphere) {
  const Rendering r = render("scene:plane?size=9x5&guard-band=0&tilt-x=40&tilt-y=-20");
  Result result(r);
  ASSERT_TRUE(trace_geometric(r, endless(1024), result.all()).ok());
  for (int i = 0; i < 45; ++i) {
    const double n[] = {r.gbuffer.normal_x[i], r.gbuffer.normal_y[i], r.gbuffer.normal_z[i]};
    EXPECT_EQ(result.visibility[i], 1);
    EXPECT_EQ(result.error[i], 0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(result.bent[3 * i + c], n[c], 0.005);
      EXPECT_NEAR(result.uniform[3 * i + c], n[c], 0.005);
      EXPECT_NEAR(result.cosine[3 * i + c], n[c] * 2 / 3, 0.005);
    }
    EXPECT_NEAR(result.cone[i], kPi / 2, 0.01);
  }
}

// Falloffs written in other ways must agree with the named ones.
TEST(Geometric, FalloffsAgreeWithTablesAndFunctions) {
  const Rendering r = render("scene:cornell?size=24x14&guard-band=0");
  GeometricSettings named, other;
  named.rays = other.rays = 64;
  auto compare = [&](const char* what) {
    Result a(r), b(r);
    ASSERT_TRUE(trace_geometric(r, named, a.only_visibility()).ok());
    ASSERT_TRUE(trace_geometric(r, other, b.only_visibility()).ok());
    for (std::size_t i = 0; i < a.visibility.size(); ++i) {
      ASSERT_NEAR(a.visibility[i], b.visibility[i], 2e-4) << what;
    }
  };
  named.falloff = {.kind = FalloffKind::kExponential, .radius = 0.3f};
  other.falloff.kind = FalloffKind::kFunction;
  other.falloff.function = [](float d) { return std::exp(-d / 0.3f); };
  compare("exponential");
  named.falloff.kind = FalloffKind::kInverseSquare;
  other.falloff.function = [](float d) { return 1 / (1 + d * d / 0.09f); };
  compare("inverse square");
  named.falloff.kind = FalloffKind::kConstant;
  other.falloff.function = [](float d) { return d <= 0.3f ? 1.0f : 0.0f; };
  compare("constant");
  named.falloff.kind = FalloffKind::kQuadratic;
  other.falloff = {.kind = FalloffKind::kTable, .radius = 0.3f, .table = std::vector<float>(101)};
  for (int i = 0; i <= 100; ++i) {
    other.falloff.table[i] = float((1 - i / 100.0) * (1 - i / 100.0));
  }
  compare("table");
}

TEST(Geometric, SeedsDifferAsTheStatedErrorSays) {
  const Rendering r = render("scene:cornell?size=32x18&guard-band=0");
  GeometricSettings s;
  s.rays = 256;
  s.falloff.radius = 0.5f;
  Result a(r), b(r);
  ASSERT_TRUE(trace_geometric(r, s, a.all()).ok());
  s.seed = 2;
  ASSERT_TRUE(trace_geometric(r, s, b.all()).ok());
  double squares = 0, stated = 0;
  for (std::size_t i = 0; i < a.visibility.size(); ++i) {
    squares += std::pow(a.visibility[i] - b.visibility[i], 2);
    stated += a.error[i] * a.error[i] + b.error[i] * b.error[i];
  }
  EXPECT_GT(squares, 0);
  EXPECT_NEAR(squares / stated, 0.85, 0.35);
}

TEST(Geometric, SameBitsForAnyNumberOfThreads) {
  const Rendering r = render("scene:hall?size=40x22&guard-band=0");
  GeometricSettings s;
  s.rays = 30;
  Result a(r), b(r);
  const auto one = make_executor(1), two = make_executor(2);
  ASSERT_TRUE(trace_geometric(r, s, a.all(), {.executor = one.get()}).ok());
  ASSERT_TRUE(trace_geometric(r, s, b.all(), {.executor = two.get()}).ok());
  EXPECT_EQ(a.visibility, b.visibility);
  EXPECT_EQ(a.bent, b.bent);
  EXPECT_EQ(a.cosine, b.cosine);
  EXPECT_EQ(a.error, b.error);
}

TEST(Geometric, SubsetIsTheWholeAtItsPixels) {
  const Rendering r = render("scene:tower?size=46x26&guard-band=3");
  GeometricSettings s;
  s.rays = 16;
  Result whole(r), subset(r), filled(r);
  ASSERT_TRUE(trace_geometric(r, s, whole.only_visibility()).ok());
  s.every = 5;
  ASSERT_TRUE(trace_geometric(r, s, subset.only_visibility()).ok());
  s.interpolate = true;
  ASSERT_TRUE(trace_geometric(r, s, filled.only_visibility()).ok());
  double difference = 0;
  int count = 0;
  for (int y = 0; y < 26; ++y) {
    for (int x = 0; x < 46; ++x) {
      const int i = y * 46 + x;
      if (!std::isfinite(r.gbuffer.depth[(y + 3) * 52 + x + 3])) {
        EXPECT_EQ(subset.visibility[i], 1);
      } else if (x % 5 == 2 && y % 5 == 2) {
        EXPECT_EQ(subset.visibility[i], whole.visibility[i]);
        EXPECT_EQ(filled.visibility[i], whole.visibility[i]);
      } else {
        EXPECT_TRUE(std::isnan(subset.visibility[i]));
        if (!std::isfinite(filled.visibility[i])) continue;
        difference += std::abs(filled.visibility[i] - whole.visibility[i]);
        ++count;
      }
    }
  }
  EXPECT_GT(count, 100);
  EXPECT_LT(difference / count, 0.1);
}

TEST(Geometric, StopsWhenAsked) {
  const Rendering r = render("scene:hall?size=64x36&guard-band=0");
  Result result(r);
  int calls = 0;
  RunOptions options;
  options.progress = [&](double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    return ++calls < 3;
  };
  EXPECT_EQ(trace_geometric(r, {}, result.only_visibility(), options).code(),
            StatusCode::kCancelled);
  EXPECT_EQ(calls, 3);
}

TEST(Geometric, RefusesWhatItCannotUse) {
  const Rendering r = render("scene:plane?size=8x8&guard-band=0");
  Result result(r);
  auto refuse = [&](GeometricSettings s, const char* message) {
    const Status status = trace_geometric(r, s, result.only_visibility());
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find(message), std::string::npos) << status.message();
    EXPECT_EQ(result.visibility[0], -7);
  };
  refuse({.rays = 0}, "rays is 0");
  refuse({.every = 0}, "every is 0");
  refuse({.falloff = {.radius = -1}}, "radius is -1");
  refuse({.offset = -1}, "offset is -1");
  EXPECT_EQ(trace_geometric({}, {}, result.only_visibility()).code(), StatusCode::kInvalidInput);
}

}  // namespace
}  // namespace obscura::tools
