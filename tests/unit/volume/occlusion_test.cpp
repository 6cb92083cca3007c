#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hwy/targets.h"
#include "obscura/volume.h"
#include "tests/reference/volume_sweeps.h"
#include "volume/occlusion_kernel.h"
#include "volume/transport.h"

namespace obscura {
namespace {

using reference::Grid;

GridView<const float> view_of(const Grid& g) { return {g.v.data(), g.size, g.spacing}; }
GridView<float> out_of(Grid& g) { return {g.v.data(), g.size, g.spacing}; }

constexpr Transport kAll[] = {Transport::kPaper, Transport::kFast, Transport::kBalanced,
                              Transport::kAccurate};

constexpr Transport kBetter[] = {Transport::kFast, Transport::kBalanced, Transport::kAccurate};

VisibilityField field_of(const Grid& d, OcclusionSettings settings = {}, int threads = 1) {
  VisibilityField field;
  auto executor = make_executor(threads);
  RunOptions run;
  run.executor = executor.get();
  const Status s = sweep_occlusion(view_of(d), settings, &field, run);
  EXPECT_TRUE(s.ok()) << s.message();
  return field;
}

float light_at(const VisibilityField& f, const SurfacePoint& p, const LightSettings& s = {}) {
  float v = -1;
  const Status status = f.light(std::span(&p, 1), s, std::span(&v, 1));
  EXPECT_TRUE(status.ok()) << status.message();
  return v;
}

Grid blobs(std::array<int, 3> n, std::array<float, 3> h = {1, 1, 1}) {
  Grid d(n, h);
  d.fill([](double x, double y, double z) {
    const double a = std::hypot(x - 9.3, y - 8.1, z - 6.7) - 4.4;
    const double b = std::hypot(x - 20.2, y - 15.4, z - 11.9) - 5.7;
    return std::min({a, b, z - 2.3 + 0.1 * x});
  });
  return d;
}

std::array<float, 3> unit(double x, double y, double z) {
  const double l = std::hypot(x, y, z);
  return {float(x / l), float(y / l), float(z / l)};
}

// Fixed point in skewed vectors against plain loops in floats, for sizes that fill no vector.
void compare_vectors_with_loops() {
  for (const std::array<int, 3> n : {std::array<int, 3>{31, 22, 18},
                                     {16, 16, 16},
                                     {1, 37, 40},
                                     {47, 1, 5},
                                     {33, 34, 1},
                                     {70, 33, 9}}) {
    const Grid d = blobs(n, {1, 1, n[0] == 16 ? 2.0f : 1.0f});
    for (Transport t : kAll) {
      const VisibilityField bytes = field_of(d, {.transport = t});
      const VisibilityField floats =
          field_of(d, {.transport = t, .precision = VisibilityPrecision::kF32});
      ASSERT_EQ(bytes.size(), floats.size());
      Grid a(bytes.size()), b(bytes.size());
      for (int s = 0; s < 8; ++s) {
        ASSERT_TRUE(bytes.octant(s, out_of(a)).ok());
        ASSERT_TRUE(floats.octant(s, out_of(b)).ok());
        for (std::size_t i = 0; i < a.v.size(); ++i) {
          ASSERT_NEAR(a.v[i], b.v[i], 0.005)
              << enum_name(t) << " octant " << s << " voxel " << i << " of " << n[0] << "x" << n[1];
        }
      }
    }
  }
}

TEST(Occlusion, VectorsAgreeWithPlainLoopsOnEveryTarget) {
  for (const std::uint32_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    compare_vectors_with_loops();
    hwy::SetSupportedTargetsForTest(0);
  }
}

// Equation 6 written out, as the paper has it: a sum of three over three.
TEST(Occlusion, PaperIsEquation6) {
  const Grid d = blobs({19, 15, 13});
  const VisibilityField field =
      field_of(d, {.transport = Transport::kPaper, .precision = VisibilityPrecision::kF32});
  Grid v(d.size), ours(d.size);
  for (int s = 0; s < 8; ++s) {
    const int sx = s & 1 ? 1 : -1, sy = s & 2 ? 1 : -1, sz = s & 4 ? 1 : -1;
    auto passed = [&](int x, int y, int z) {
      if (x < 0 || y < 0 || z < 0 || x >= d.size[0] || y >= d.size[1] || z >= d.size[2])
        return 1.0f;
      return v(x, y, z) * std::round(255 * std::clamp(d(x, y, z) + 0.5f, 0.0f, 1.0f)) / 255;
    };
    for (int k = 0; k < d.size[2]; ++k) {
      for (int j = 0; j < d.size[1]; ++j) {
        for (int i = 0; i < d.size[0]; ++i) {
          const int x = sx < 0 ? i : d.size[0] - 1 - i, y = sy < 0 ? j : d.size[1] - 1 - j;
          const int z = sz < 0 ? k : d.size[2] - 1 - k;
          v(x, y, z) = (passed(x + sx, y, z) + passed(x, y + sy, z) + passed(x, y, z + sz)) / 3;
        }
      }
    }
    ASSERT_TRUE(field.octant(s, out_of(ours)).ok());
    for (std::size_t i = 0; i < v.v.size(); ++i) ASSERT_NEAR(ours.v[i], v.v[i], 3e-3) << s;
  }
}

TEST(Occlusion, APlaneIsOpenWhateverItsTiltAndOffset) {
  std::mt19937 rng(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> offset(-1, 1);
  for (int i = 0; i < 25; ++i) {
    const auto n = i == 0 ? unit(0, 0, 1) : unit(normal(rng), normal(rng), normal(rng));
    const double c = 20 * (n[0] + n[1] + n[2]) + offset(rng);
    Grid d({41, 41, 41});
    d.fill([&](double x, double y, double z) { return n[0] * x + n[1] * y + n[2] * z - c; });
    const double lift = c - 20 * (n[0] + n[1] + n[2]);
    const SurfacePoint p{
        {float(20 + lift * n[0]), float(20 + lift * n[1]), float(20 + lift * n[2])}, n};
    for (Transport t : kBetter) {
      EXPECT_GT(light_at(field_of(d, {.transport = t}), p), 0.98)
          << enum_name(t) << " " << n[0] << " " << n[1] << " " << n[2] << " " << lift;
    }
  }
}

// Off the voxels' own heights too, and with unequal spacing.
TEST(Occlusion, AnUprightPlaneIsOpenAtEveryOffset) {
  for (const float height : {1.0f, 1.6f}) {
    for (int i = 0; i < 20; ++i) {
      const float c = 9 + 0.1f * float(i);
      Grid d({24, 24, 24}, {1, 1, height});
      d.fill([&](double, double, double z) { return z - c; });
      const SurfacePoint p{{11.3f, 12.1f, c}, {0, 0, 1}};
      for (Transport t : kBetter) {
        EXPECT_GT(light_at(field_of(d, {.transport = t}), p), 0.98) << enum_name(t) << " " << c;
      }
    }
  }
}

// Nothing outside the volume takes light: not where a plane meets the border, nor where the border
// cuts matter.
TEST(Occlusion, TheBorderIsOpen) {
  Grid d({40, 41, 30});
  d.fill([](double, double, double z) { return z - 8.3; });
  for (Transport t : kBetter) {
    const VisibilityField field = field_of(d, {.transport = t});
    for (const float x : {0.0f, 0.6f, 2.0f, 38.2f, 39.0f}) {
      for (const float y : {0.0f, 1.3f, 20.0f, 40.0f}) {
        EXPECT_GT(light_at(field, {{x, y, 8.3f}, {0, 0, 1}}), 0.98) << x << " " << y;
      }
    }
    EXPECT_GT(light_at(field, {{0, 20, 5}, {-1, 0, 0}}), 0.97);
    EXPECT_GT(light_at(field, {{39, 20, 5}, {1, 0, 0}}), 0.97);
    EXPECT_GT(light_at(field, {{20, 40, 3}, {0, 1, 0}}), 0.97);
    EXPECT_GT(light_at(field, {{20, 20, 0}, {0, 0, -1}}), 0.97);
  }
  // A look-up beyond the border still sees what is within: a pit at the border is dark.
  d.fill([](double x, double, double z) { return std::min(z - 2.0, 1.5 - std::fabs(x - 2.0)); });
  const VisibilityField pit = field_of(d);
  EXPECT_LT(light_at(pit, {{2, 20, 2}, {0, 0, 1}}), 0.4);
}

TEST(Occlusion, ALoneSphereIsOpen) {
  Grid d({48, 48, 48});
  d.fill(
      [](double x, double y, double z) { return std::hypot(x - 23.4, y - 23.9, z - 24.2) - 14.3; });
  std::mt19937 rng(8);
  std::normal_distribution<double> normal;
  for (Transport t : kBetter) {
    const VisibilityField field = field_of(d, {.transport = t});
    for (int i = 0; i < 50; ++i) {
      const auto n = unit(normal(rng), normal(rng), normal(rng));
      EXPECT_GT(light_at(field, {{float(23.4 + 14.3 * n[0]), float(23.9 + 14.3 * n[1]),
                                  float(24.2 + 14.3 * n[2])},
                                 n}),
                0.97)
          << enum_name(t) << " " << n[0] << " " << n[1] << " " << n[2];
    }
  }
}

// Root mean square error on the plane under a sphere, which is 1 - h r^2 / l^3 with l from the
// centre at height h, on a grid of side^3.
struct SphereOverPlane {
  Grid d;
  std::vector<SurfacePoint> points{};
  std::vector<double> expected{};

  explicit SphereOverPlane(int side) : d({side, side, side}) {
    const double s = side / 64.0, middle = (side - 1) / 2.0, floor = 8.3 * s, centre = 34.0 * s;
    d.fill([&](double x, double y, double z) {
      return std::min(std::hypot(x - middle, y - middle, z - centre) - 14 * s, z - floor);
    });
    for (double y = -20; y < 21; y += 3) {
      for (double x = -20; x < 21; x += 3) {
        points.push_back({{float(middle + s * x), float(middle + s * y), float(floor)}, {0, 0, 1}});
        const double l = std::hypot(x, y, 34.0 - 8.3);
        expected.push_back(1 - (34.0 - 8.3) * 14 * 14 / (l * l * l));
      }
    }
  }
  double error(const std::vector<float>& v) const {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += std::pow(v[i] - expected[i], 2);
    return std::sqrt(sum / double(v.size()));
  }
  double error(Transport t) const {
    std::vector<float> v(points.size());
    EXPECT_TRUE(field_of(d, {.transport = t}).light(points, {}, v).ok());
    return error(v);
  }
};

TEST(Occlusion, ASphereOverAPlaneIsItsClosedForm) {
  const SphereOverPlane scene(64);
  std::vector<float> v(scene.points.size());
  MonteCarloSettings mc;
  mc.rays = 256;
  ASSERT_TRUE(monte_carlo_visibility(view_of(scene.d), scene.points, mc, v).ok());
  EXPECT_LT(scene.error(v), 0.02);
  for (Transport t : kBetter) {
    EXPECT_LT(scene.error(t), t == Transport::kFast ? 0.065 : 0.035) << enum_name(t);
  }
}

TEST(Occlusion, FinerGridsAreNotWorse) {
  const SphereOverPlane coarse(50), middle(100), fine(200);
  for (Transport t : kBetter) {
    const double at_50 = coarse.error(t), at_100 = middle.error(t), at_200 = fine.error(t);
    EXPECT_LT(at_100, at_50) << enum_name(t);
    EXPECT_LT(at_200, at_50) << enum_name(t);
    // Beams of few directions are a little sharper on a finer grid.
    EXPECT_LT(at_200, 1.2 * at_100) << enum_name(t);
  }
}

TEST(Occlusion, OpenSpaceIsOneAndMatterIsClosed) {
  const Grid open({20, 20, 20}, {1, 1, 1}, 5), matter({20, 20, 20}, {1, 1, 1}, -5);
  for (Transport t : kAll) {
    const SurfacePoint p{{9.7f, 9.2f, 10.4f}, unit(1, 2, -3)};
    EXPECT_EQ(light_at(field_of(open, {.transport = t}), p), 1.0f) << enum_name(t);
    EXPECT_LT(light_at(field_of(matter, {.transport = t}), p), 0.01f) << enum_name(t);
    // Translucent: nothing in the way is still exactly open.
    EXPECT_EQ(light_at(field_of(open, {.transport = t, .alpha = 0.3f}), p), 1.0f);
    EXPECT_EQ(light_at(field_of(matter, {.transport = t, .alpha = 0}), p), 1.0f);
  }
}

TEST(Occlusion, OctantsAddUp) {
  const Grid d = blobs({40, 36, 30});
  const VisibilityField field = field_of(d);
  const SurfacePoint p{{12.0f, 20.0f, 1.1f}, unit(-0.1, 0, 1)};
  float sum = 0;
  for (int s = 0; s < 8; ++s) {
    LightSettings one;
    one.octants = 1u << s;
    sum += light_at(field, p, one);
  }
  EXPECT_NEAR(sum, light_at(field, p), 1e-5);
  LightSettings upper;
  upper.octants = 0xF0;
  EXPECT_NEAR(light_at(field, p, upper), sum, 0.06);  // hardly tilted
}

TEST(Occlusion, ScalarIsTheMeanOfTheOctants) {
  const Grid d = blobs({25, 18, 14});
  for (VisibilityPrecision precision : {VisibilityPrecision::kU8, VisibilityPrecision::kF32}) {
    const VisibilityField field = field_of(d, {.precision = precision});
    Grid mean(field.size()), one(field.size()), sum(field.size());
    ASSERT_TRUE(field.scalar(out_of(mean)).ok());
    for (int s = 0; s < 8; ++s) {
      ASSERT_TRUE(field.octant(s, out_of(one)).ok());
      for (std::size_t i = 0; i < sum.v.size(); ++i) sum.v[i] += one.v[i] / 8;
    }
    for (std::size_t i = 0; i < sum.v.size(); ++i) ASSERT_NEAR(mean.v[i], sum.v[i], 1e-5);
  }
}

TEST(Occlusion, FallsWhenAnOccluderIsAdded) {
  Grid d({40, 40, 40});
  d.fill([](double, double, double z) { return z - 8.2; });
  const SurfacePoint p{{19.5f, 19.5f, 8.2f}, {0, 0, 1}};
  for (Transport t : kAll) {
    const float before = light_at(field_of(d, {.transport = t}), p);
    Grid more = d;
    more.fill([](double x, double y, double z) {
      return std::min(z - 8.2, std::hypot(x - 26, y - 17, z - 20) - 6);
    });
    EXPECT_LT(light_at(field_of(more, {.transport = t}), p), before - 0.01) << enum_name(t);
  }
}

TEST(Shadow, OfASphereFallsAwayFromTheLight) {
  Grid d({48, 48, 48});
  d.fill([](double x, double y, double z) {
    return std::min(std::hypot(x - 24, y - 24, z - 26) - 6, z - 6.2);
  });
  for (const auto& light :
       {unit(0.5, 0.2, 1), unit(-1, 0.1, 0.8), unit(0, 0, 1), unit(-1, -1, -1)}) {
    if (light[2] < 0) continue;
    VisibilityField field;
    ASSERT_TRUE(sweep_shadow(view_of(d), light, {.transport = Transport::kAccurate}, &field).ok());
    const float t = (26 - 6.2f) / light[2];
    const SurfacePoint dark{{24 - t * light[0], 24 - t * light[1], 6.2f}, {0, 0, 1}};
    const SurfacePoint bright{{24 + 0.5f * t * light[0], 42, 6.2f}, {0, 0, 1}};
    float hard[2];
    const SurfacePoint both[] = {dark, bright};
    ASSERT_TRUE(hard_shadow(view_of(d), both, light, {}, hard).ok());
    if (dark.position[0] > 3 && dark.position[0] < 45) {
      EXPECT_EQ(hard[0], 0);
      EXPECT_LT(light_at(field, dark), light_at(field, bright) - 0.1);
    }
    EXPECT_EQ(hard[1], 1);
  }
  VisibilityField field;
  EXPECT_TRUE(sweep_shadow(view_of(d), {-1, -1, -1}, {}, &field).ok());
}

TEST(Occlusion, MistakesAreNamed) {
  Grid d({8, 8, 8}, {1, 1, 1}, 5);
  VisibilityField field;
  auto expect = [](const Status& s, const char* what) {
    EXPECT_FALSE(s.ok());
    EXPECT_NE(s.message().find(what), std::string::npos) << s.message();
  };
  const SurfacePoint p{{4, 4, 4}, {0, 0, 1}};
  float v[2];
  expect(field.light(std::span(&p, 1), {}, std::span(v, 1)), "empty");
  expect(sweep_occlusion(view_of(d), {.alpha = 2}, &field), "alpha");
  EXPECT_TRUE(field.empty());
  expect(sweep_occlusion({}, {}, &field), "distance.data");
  expect(sweep_shadow(view_of(d), {0, 0, 0}, {}, &field), "to_light");
  ASSERT_TRUE(sweep_occlusion(view_of(d), {}, &field).ok());
  expect(field.light(std::span(&p, 1), {.octants = 0}, std::span(v, 1)), "octants");
  expect(field.light(std::span(&p, 1), {}, std::span(v, 2)), "visibility holds 2");
  expect(field.octant(8, out_of(d)), "octant is 8");
  expect(field.octant(1, out_of(d)), "4x4x4");
  MonteCarloSettings mc;
  mc.rays = 0;
  expect(monte_carlo_visibility(view_of(d), std::span(&p, 1), mc, std::span(v, 1)), "rays");
}

}  // namespace
}  // namespace obscura
