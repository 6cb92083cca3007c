#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "obscura/volume.h"
#include "tests/reference/volume_sweeps.h"
#include "volume/distance_kernel.h"
#include "volume/distance_start.h"

namespace obscura {
namespace {

using reference::Grid;

VolumeView view_of(const Grid& g) {
  VolumeView v;
  v.data = g.v.data();
  v.size = g.size;
  v.spacing = g.spacing;
  return v;
}
GridView<float> out_of(Grid& g) { return {g.v.data(), g.size, g.spacing}; }

// Distances of a field that is negative inside, by the library.
Grid swept(const Grid& f, DistanceSettings settings = {}, int threads = 1) {
  settings.solid = SolidSide::kBelow;
  Grid d(f.size, f.spacing);
  auto executor = make_executor(threads);
  RunOptions run;
  run.executor = executor.get();
  const Status s = sweep_distance(view_of(f), settings, out_of(d), run);
  EXPECT_TRUE(s.ok()) << s.message();
  return d;
}

Grid blobs(std::array<int, 3> n, std::array<float, 3> h = {1, 1, 1}) {
  Grid f(n, h);
  f.fill([](double x, double y, double z) {
    const double a = std::hypot(x - 9.3, y - 8.1, z - 6.7) - 4.4;
    const double b = std::hypot(x - 20.2, y - 15.4, z - 11.9) - 5.7;
    return std::min(a, b);
  });
  return f;
}

double largest_difference(const Grid& a, const Grid& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.v.size(); ++i) {
    most = std::max(most, std::fabs(double{a.v[i]} - b.v[i]));
  }
  return most;
}

TEST(Distance, AgreesWithPlainLoopsWhenNothingChangesAnyMore) {
  for (const std::array<float, 3> h : {std::array<float, 3>{1, 1, 1}, {0.8f, 1.1f, 1.6f}}) {
    for (const std::array<int, 3> n : {std::array<int, 3>{37, 29, 23}, {16, 16, 16}, {25, 40, 9}}) {
      const Grid f = blobs(n, h);
      DistanceSettings settings;
      settings.converge = true;
      settings.solid = SolidSide::kBelow;
      const Grid ours = swept(f, settings);
      Grid plain(n, h);
      auto executor = make_executor(1);
      start_distance(view_of(f), 0, settings, out_of(plain), *executor);
      reference::sweep_distance(plain, 12);
      EXPECT_LT(largest_difference(ours, plain), 2e-5) << n[0] << "x" << n[1] << "x" << n[2];
    }
  }
}

TEST(Distance, OfASphereIsNearTheTruth) {
  Grid f({48, 48, 48});
  auto sphere = [](double x, double y, double z) {
    return std::hypot(x - 23.2, y - 24.1, z - 23.7) - 11.3;
  };
  f.fill(sphere);
  const Grid d = swept(f);
  double sum = 0, most = 0, beside = 0;
  int count = 0;
  Grid truth(f.size);
  truth.fill(sphere);
  for (std::size_t i = 0; i < d.v.size(); ++i) {
    const double e = std::fabs(double{d.v[i]} - truth.v[i]);
    sum += e;
    most = std::max(most, e);
    if (std::fabs(truth.v[i]) < 0.5) beside += e, ++count;
    ASSERT_EQ(d.v[i] > 0, truth.v[i] > 0);
  }
  EXPECT_LT(sum / double(d.v.size()), 0.35);  // first order: h log h
  EXPECT_LT(most, 1.0);
  EXPECT_LT(beside / count, 0.01);
}

TEST(Distance, OfAPlaneIsExactWhateverItsTilt) {
  for (const auto& n : {std::array<double, 3>{0, 0, 1}, {0.6, 0, 0.8}, {0.48, 0.6, 0.64}}) {
    Grid f({30, 30, 30}, {1.0f, 0.7f, 1.3f});
    f.fill([&](double x, double y, double z) { return n[0] * x + n[1] * y + n[2] * z - 19.37; });
    const Grid d = swept(f);
    // Where the grid's border has not cut the characteristics off.
    for (int z = 11; z < 20; ++z) {
      for (int y = 11; y < 20; ++y) {
        for (int x = 11; x < 20; ++x) {
          if (std::fabs(f(x, y, z)) > 6) continue;
          EXPECT_NEAR(d(x, y, z), f(x, y, z), 0.02) << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(Distance, SidesMirror) {
  Grid f = blobs({20, 20, 20});
  Grid below = swept(f);
  for (float& v : f.v) v = -v;
  Grid above(f.size);
  DistanceSettings settings;
  settings.solid = SolidSide::kAbove;
  ASSERT_TRUE(sweep_distance(view_of(f), settings, out_of(above)).ok());
  EXPECT_EQ(below.v, above.v);
}

TEST(Distance, BitsDoNotDependOnThreads) {
  const Grid f = blobs({61, 43, 37}, {1, 1.2f, 0.9f});
  const Grid one = swept(f, {}, 1);
  for (int threads : {2, 3, 8}) EXPECT_EQ(one.v, swept(f, {}, threads).v);
}

TEST(Distance, AxesOfOneVoxel) {
  for (int axis = 0; axis < 3; ++axis) {
    std::array<int, 3> n{24, 24, 24};
    n[axis] = 1;
    Grid f(n);
    f.fill([&](double x, double y, double z) {
      const std::array<double, 3> p{x, y, z};
      return p[(axis + 1) % 3] + p[(axis + 2) % 3] - 20.3;
    });
    const Grid d = swept(f);
    for (std::size_t i = 0; i < d.v.size(); ++i) {
      EXPECT_NEAR(d.v[i], f.v[i] / std::sqrt(2.0), 0.9);
      EXPECT_EQ(d.v[i] > 0, f.v[i] > 0);
    }
  }
  Grid line({1, 1, 9});
  line.fill([](double, double, double z) { return z - 3.25; });
  const Grid d = swept(line);
  for (int z = 0; z < 9; ++z) EXPECT_NEAR(d(0, 0, z), z - 3.25, 1e-5);
}

TEST(Distance, NanIsOpenAndInfinityIsWhatItsSignSays) {
  Grid f({9, 9, 9}, {1, 1, 1}, 5.0f);
  f(4, 4, 4) = -1;
  f(2, 2, 2) = std::numeric_limits<float>::quiet_NaN();
  f(6, 6, 6) = -std::numeric_limits<float>::infinity();
  f(6, 2, 6) = std::numeric_limits<float>::infinity();
  const Grid d = swept(f);
  for (float v : d.v) EXPECT_TRUE(std::isfinite(v));
  EXPECT_GT(d(2, 2, 2), 0);
  EXPECT_LT(d(4, 4, 4), 0);
  EXPECT_LT(d(6, 6, 6), 0);
  EXPECT_GT(d(6, 2, 6), 0);
}

TEST(Distance, EdgeStartIsThePapers) {
  Grid f({12, 12, 12});
  f.fill([](double x, double y, double z) { return (x + y + z) / std::sqrt(3.0) - 9.1; });
  DistanceSettings settings;
  settings.start = DistanceStart::kEdges;
  const Grid edges = swept(f, settings), gradient = swept(f);
  // Along an edge a plane through the diagonal is sqrt 3 times as far away.
  EXPECT_NEAR(edges(5, 5, 5), f(5, 5, 5) * std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(gradient(5, 5, 5), f(5, 5, 5), 1e-4);
}

TEST(Distance, ReadsTypesScalesAndStrides) {
  std::vector<std::uint8_t> samples(2 * 10 * 9 * 8);
  Grid f({10, 9, 8});
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 10; ++x) {
        const int v = 20 * x + 3 * y;
        samples[2 * (x * 72 + y * 8 + z)] = static_cast<std::uint8_t>(v);
        f(x, y, z) = static_cast<float>(0.5 * v - 7);
      }
    }
  }
  VolumeView v;
  v.data = samples.data();
  v.type = VoxelType::kU8;
  v.size = f.size;
  v.stride = {144, 16, 2};
  v.slope = 0.5f;
  v.intercept = -7;
  DistanceSettings settings;
  settings.isovalue = 31;
  settings.solid = SolidSide::kBelow;
  Grid a(f.size), b(f.size);
  ASSERT_TRUE(sweep_distance(v, settings, out_of(a)).ok());
  ASSERT_TRUE(sweep_distance(view_of(f), settings, out_of(b)).ok());
  EXPECT_EQ(a.v, b.v);
}

TEST(Distance, MistakesAreNamedAndOutputsUntouched) {
  Grid f = blobs({12, 12, 12}), d(f.size, f.spacing, 7);
  auto expect = [&](const VolumeView& v, DistanceSettings s, const char* what) {
    s.solid = SolidSide::kBelow;
    const Status status = sweep_distance(v, s, out_of(d));
    EXPECT_FALSE(status.ok());
    EXPECT_NE(status.message().find(what), std::string::npos) << status.message();
    for (float value : d.v) ASSERT_EQ(value, 7);
  };
  VolumeView v = view_of(f);
  DistanceSettings s;
  s.isovalue = 1000;
  expect(v, s, "its values go from");
  s.isovalue = std::numeric_limits<float>::quiet_NaN();
  expect(v, s, "isovalue");
  s = {};
  s.sweeps = 0;
  expect(v, s, "sweeps");
  s = {};
  v.spacing[1] = 0;
  expect(v, s, "spacing along y");
  v = view_of(f);
  v.size[2] = 0;
  expect(v, s, "size along z");
  v = view_of(f);
  v.size[2] = 11;
  expect(v, s, "distance.size");
  v = view_of(f);
  v.data = nullptr;
  expect(v, s, "volume.data");
  v = view_of(f);
  v.slope = 0;
  expect(v, s, "slope");
}

TEST(Distance, ProgressMayCancel) {
  const Grid f = blobs({12, 12, 12});
  Grid d(f.size);
  RunOptions run;
  run.progress = [](double) { return false; };
  DistanceSettings s;
  s.solid = SolidSide::kBelow;
  EXPECT_EQ(sweep_distance(view_of(f), s, out_of(d), run).code(), StatusCode::kCancelled);
}

}  // namespace
}  // namespace obscura
