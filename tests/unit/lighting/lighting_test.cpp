#include "obscura/lighting.h"

#include <algorithm>
#include <limits>

#include "tests/unit/lighting/environments.h"

namespace obscura {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr double kPi = std::numbers::pi;
constexpr LightingTechnique kTechniques[] = {LightingTechnique::kAmbientOcclusion,
                                             LightingTechnique::kBentNormal,
                                             LightingTechnique::kBentCone};

PreconvolvedEnvironment convolved(const Environment& e, const RunOptions& options = {}) {
  PreconvolvedEnvironment p;
  const Status s = PreconvolvedEnvironment::make(e, {}, &p, options);
  EXPECT_TRUE(s.ok()) << s.message();
  return p;
}

Direction rough(const Direction& d) {
  return {1 + std::max(0.0f, d[1]), 1 + d[0] * d[2], std::exp(3 * d[0] - 3)};
}

// Three pixels in a row, of any stride.
struct Pixels {
  explicit Pixels(int w) : width(w), visibility(w, 1.0f), angle(w, 1.0f) {
    for (auto* v : {&normal, &bent, &albedo, &out}) v->assign(3 * w, 0.0f);
    for (int x = 0; x < w; ++x) set(normal, x, {0, 0, 1}), set(bent, x, {0, 0, 1});
    for (int x = 0; x < w; ++x) set(albedo, x, {1, 1, 1});
  }
  static void set(std::vector<float>& v, int x, const Direction& d) {
    std::copy(d.begin(), d.end(), v.begin() + 3 * x);
  }
  VectorView<float> view(std::vector<float>& v) {
    return VectorView<float>::interleaved(v.data(), width, 1);
  }
  LightingInputs inputs() {
    return {ImageView<float>(visibility.data(), width, 1), view(normal), view(bent),
            ImageView<float>(angle.data(), width, 1), view(albedo)};
  }
  Direction lit(const PreconvolvedEnvironment& e, const LightingSettings& s, int x = 0) {
    const Status status = light(inputs(), e, s, view(out));
    EXPECT_TRUE(status.ok()) << status.message();
    return {out[3 * x], out[3 * x + 1], out[3 * x + 2]};
  }

  int width;
  std::vector<float> visibility, angle, normal, bent, albedo, out;
};

TEST(Lighting, ConstantLightStaysConstantForEveryTechnique) {
  const PreconvolvedEnvironment e = convolved(make_environment(
      [](const Direction&) {
        return Direction{2, 1, 0.5f};
      },
      16));
  for (LightingTechnique technique : kTechniques) {
    Pixels p(50);
    for (int x = 0; x < p.width; ++x) {
      p.visibility[x] = static_cast<float>(x) / 50;
      p.angle[x] = static_cast<float>(x) * 0.04f;
      p.set(p.bent, x, unit(x - 20, 3 + x % 7, 5));
    }
    p.lit(e, {.technique = technique});
    for (int x = 0; x < p.width; ++x) {
      EXPECT_NEAR(p.out[3 * x], 2 * p.visibility[x], 0.001 * p.visibility[x]);
      EXPECT_NEAR(p.out[3 * x + 2], 0.5 * p.visibility[x], 0.001 * p.visibility[x]);
    }
  }
}

TEST(Lighting, PapersNormalisationAndGeometricTermAreTheFactorsTheySay) {
  const PreconvolvedEnvironment e = convolved(make_environment(
      [](const Direction&) {
        return Direction{1, 1, 1};
      },
      16));
  for (float a : {0.3f, 0.8f, 1.2f}) {
    Pixels p(1);
    p.angle[0] = a;
    p.set(p.bent, 0, unit(1, 0, 1));
    EXPECT_NEAR(p.lit(e, {.normalisation = ConeNormalisation::kPaper})[0], 1 + std::cos(a), 1e-3);
    EXPECT_NEAR(p.lit(e, {.geometric_term = true})[0], std::sqrt(0.5), 1e-3);
  }
}

// 1/pi integral of L (v.w) within a cone, by quadrature in the cone's own coordinates.
template <class Radiance>
Direction cone_light(const Radiance& radiance, const Direction& axis, double angle) {
  const Direction side =
      std::abs(axis[0]) < 0.7f ? unit(0, axis[2], -axis[1]) : unit(-axis[2], 0, axis[0]);
  const Direction up = {axis[1] * side[2] - axis[2] * side[1],
                        axis[2] * side[0] - axis[0] * side[2],
                        axis[0] * side[1] - axis[1] * side[0]};
  std::array<double, 3> sum{};
  const int n = 200;
  for (int i = 0; i < n; ++i) {
    const double s = std::sin(angle) * std::sqrt((i + 0.5) / n), c = std::sqrt(1 - s * s);
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / n, a = s * std::cos(phi), b = s * std::sin(phi);
      const Direction rgb = radiance(unit(c * axis[0] + a * side[0] + b * up[0],
                                          c * axis[1] + a * side[1] + b * up[1],
                                          c * axis[2] + a * side[2] + b * up[2]));
      for (int k = 0; k < 3; ++k) sum[k] += rgb[k];
    }
  }
  return {float(sum[0] / (n * n)), float(sum[1] / (n * n)), float(sum[2] / (n * n))};
}

TEST(Lighting, TableAgreesWithQuadrature) {
  const PreconvolvedEnvironment e = convolved(make_environment(rough));
  for (const Direction& d : directions()) {
    for (int level = 1; level <= 8; level += level == 1 ? 1 : 2) {
      const double angle = level * kPi / 16;
      const Direction want = cone_light(rough, d, angle);
      const auto got = e.radiance(d, static_cast<float>(angle));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], want[c], 0.01 * (0.2 + want[c])) << level;
    }
  }
}

TEST(Lighting, KernelAgreesWithTheLookUpOfOneDirection) {
  const PreconvolvedEnvironment e = convolved(make_environment(rough));
  const std::vector<Direction> all = directions();
  Pixels p(static_cast<int>(all.size()));
  for (int x = 0; x < p.width; ++x) {
    p.set(p.bent, x, all[x]);
    p.angle[x] = static_cast<float>(x % 17) * 0.1f;
  }
  // A quarter turn about y: eye x becomes world -z.
  LightingSettings settings;
  settings.world_from_eye = {0, 0, 1, 0, 1, 0, -1, 0, 0};
  p.lit(e, settings);
  for (int x = 0; x < p.width; ++x) {
    const Direction world{all[x][2], all[x][1], -all[x][0]};
    const auto want = e.radiance(world, std::min(p.angle[x], float(kPi / 2)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(p.out[3 * x + c], want[c], 1e-4) << x;
  }
}

TEST(Lighting, BadNumbersHaveTheirAnswers) {
  const PreconvolvedEnvironment e = convolved(make_environment(rough));
  for (LightingTechnique technique : kTechniques) {
    Pixels p(9);
    p.angle.assign(9, float(kPi / 2));
    p.set(p.normal, 1, {0, 0, 0});
    p.set(p.normal, 2, {0, 0, 1e30f});
    p.set(p.bent, 2, {0, 0, 0});
    p.set(p.bent, 3, {kNan, 0, 1});
    p.set(p.bent, 4, {kInf, 0, 1});
    p.set(p.bent, 5, {0, 0, 1e-20f});
    p.visibility[6] = kNan;
    p.visibility[7] = 7;
    p.angle[8] = kNan;
    const Direction good = p.lit(e, {.technique = technique});
    for (int x = 1; x < 9; ++x) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(p.out[3 * x + c], good[c], 1e-5) << x;
    }
    p.set(p.albedo, 0, {kNan, -1, 0.5f});
    const Direction lit = p.lit(e, {.technique = technique});
    EXPECT_EQ(lit[0], 0);
    EXPECT_EQ(lit[1], 0);
    EXPECT_NEAR(lit[2], 0.5 * good[2], 1e-6);
  }
}

TEST(Lighting, SunShinesThroughTheCone) {
  Environment dark = make_environment([](const Direction&) { return Direction{0, 0, 0}; }, 16);
  Environment e;
  const Sun sun{
      .direction = unit(1, 0, 1), .irradiance = {float(kPi), 0, 0}, .angular_radius = 0.05f};
  ASSERT_TRUE(dark.with_sun(sun, &e).ok());
  const PreconvolvedEnvironment lights = convolved(e);
  Pixels p(1);
  const double facing = std::sqrt(0.5);
  // The sun is 45 degrees off the normal, and the cone points along it.
  auto with_angle = [&](double degrees) {
    const double a = degrees * kPi / 180;
    p.angle[0] = static_cast<float>(a);
    p.visibility[0] = static_cast<float>(std::sin(a) * std::sin(a));  // a cap that is open
    return p.lit(lights, {})[0];
  };
  EXPECT_NEAR(with_angle(60), facing, 1e-4);
  EXPECT_NEAR(with_angle(45), facing / 2, 1e-3);
  EXPECT_EQ(with_angle(30), 0);
  p.visibility[0] = 0.5f;
  EXPECT_NEAR(p.lit(lights, {.technique = LightingTechnique::kAmbientOcclusion})[0], facing / 2,
              1e-5);
  p.set(p.bent, 0, unit(1, 0, 1));
  EXPECT_NEAR(p.lit(lights, {.technique = LightingTechnique::kBentNormal})[0], 0.5, 1e-5);
}

// Light that is linear in direction, a + b.w, gives visibility a + b.(cosine integral) exactly.
TEST(Lighting, ConesFromTheCosineIntegralAreExactForLinearLight) {
  const Direction b{0.5f, -0.3f, 0.6f};
  const auto linear = [&](const Direction& d) {
    const float v = 1 + b[0] * d[0] + b[1] * d[1] + b[2] * d[2];
    return Direction{v, v, v};
  };
  const PreconvolvedEnvironment e = convolved(make_environment(linear));
  // Visible: every other sector, above a horizon that waves.
  std::array<double, 3> integral{};
  double visibility = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    const double s = std::sqrt((i + 0.5) / n), c = std::sqrt(1 - s * s);
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / n;
      if (c < 0.45 + 0.4 * std::cos(phi)) continue;
      visibility += 1.0 / (n * n);
      const double w[3] = {s * std::cos(phi), s * std::sin(phi), c};
      for (int k = 0; k < 3; ++k) integral[k] += w[k] / (n * n);
    }
  }
  Pixels p(1);
  p.visibility[0] = static_cast<float>(visibility);
  p.set(p.bent, 0, {float(integral[0]), float(integral[1]), float(integral[2])});
  ASSERT_TRUE(cones_from_cosine_integral(p.inputs().visibility, p.inputs().bent_normal,
                                         p.view(p.bent), ImageView<float>(p.angle.data(), 1, 1))
                  .ok());
  const double want = visibility + b[0] * integral[0] + b[1] * integral[1] + b[2] * integral[2];
  EXPECT_NEAR(p.lit(e, {})[0], want, 0.003 * want);
}

TEST(Lighting, BitsDoNotDependOnThreads) {
  const Environment e = make_environment(rough, 64);
  const auto one = make_executor(1), three = make_executor(3);
  const PreconvolvedEnvironment a = convolved(e, {.executor = one.get()});
  const PreconvolvedEnvironment b = convolved(e, {.executor = three.get()});
  EXPECT_TRUE(std::equal(a.table().begin(), a.table().end(), b.table().begin()));
}

TEST(Lighting, ProgressIsToldAndCanStop) {
  const Environment e = make_environment(rough, 16);
  double last = 0;
  PreconvolvedEnvironment p;
  ASSERT_TRUE(PreconvolvedEnvironment::make(e, {.cells = 8, .source_cells = 8}, &p,
                                            {.progress =
                                                 [&](double share) {
                                                   last = share;
                                                   return true;
                                                 }})
                  .ok());
  EXPECT_GT(last, 0.5);
  EXPECT_EQ(
      PreconvolvedEnvironment::make(e, {}, &p, {.progress = [](double) { return false; }}).code(),
      StatusCode::kCancelled);
}

TEST(Lighting, TablesAreCheckedWhenTheyComeBack) {
  const PreconvolutionSettings small{.cells = 4, .source_cells = 8};
  PreconvolvedEnvironment p, back;
  ASSERT_TRUE(PreconvolvedEnvironment::make(make_environment(rough, 16), small, &p).ok());
  std::vector<float> table(p.table().begin(), p.table().end());
  ASSERT_TRUE(PreconvolvedEnvironment::from_table(small, table, {}, &back).ok());
  EXPECT_EQ(back.radiance({0, 0, 1}, 1), p.radiance({0, 0, 1}, 1));
  EXPECT_FALSE(PreconvolvedEnvironment::from_table({}, table, {}, &back).ok());
  table[5] = kNan;
  EXPECT_FALSE(PreconvolvedEnvironment::from_table(small, table, {}, &back).ok());
}

TEST(Lighting, RefusesInputsThatDoNotFit) {
  const PreconvolvedEnvironment e = convolved(make_environment(rough, 16));
  Pixels p(4), q(5);
  LightingInputs in = p.inputs();
  in.normal = q.inputs().normal;
  EXPECT_EQ(light(in, e, {}, p.view(p.out)).message(),
            "normal is 5x1; it must be 4x1, the size of visibility");
  in = p.inputs();
  in.cone_angle = {};
  EXPECT_EQ(light(in, e, {}, p.view(p.out)).message(), "cone-angle is missing");
  EXPECT_TRUE(light(in, e, {.technique = LightingTechnique::kBentNormal}, p.view(p.out)).ok());
  EXPECT_FALSE(light(p.inputs(), {}, {}, p.view(p.out)).ok());
  EXPECT_FALSE(light(p.inputs(), e, {}, q.view(q.out)).ok());
  LightingSettings scaled;
  scaled.world_from_eye[0] = 2;
  EXPECT_FALSE(light(p.inputs(), e, scaled, p.view(p.out)).ok());
}

}  // namespace
}  // namespace obscura
