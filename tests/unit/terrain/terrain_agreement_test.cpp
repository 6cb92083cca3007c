#include <gtest/gtest.h>

#include <cmath>

#include "obscura/terrain.h"
#include "tests/reference/plain_threads.h"
#include "tests/reference/terrain.h"

// The sweeps against horizons marched in small steps, and against themselves.
namespace obscura {
namespace {

using reference::Model;

struct Quantities {
  explicit Quantities(const Model& m)
      : svf(m.heights.size()), svf_normal(svf), svf_cosine(svf), openness(svf), visible(svf) {}
  TerrainOutputs outputs(const Model& m) {
    auto view = [&](std::vector<float>& v) {
      return ImageView<float>(v.data(), m.width, m.height);
    };
    TerrainOutputs o;
    o.svf = view(svf);
    o.svf_normal = view(svf_normal);
    o.svf_cosine = view(svf_cosine);
    o.openness = view(openness);
    o.visible_sky = view(visible);
    return o;
  }
  std::vector<float> svf, svf_normal, svf_cosine, openness, visible;
};

// Mean errors against 720 azimuths: of the mean in percent, of openness in degrees.
struct Errors {
  double svf, svf_normal, openness;
};
Errors errors(const Model& m, int azimuths,
              double radius = std::numeric_limits<double>::infinity()) {
  TerrainSettings settings;
  settings.azimuths = azimuths;
  settings.radius = radius;
  Quantities q(m);
  const Status s = compute_terrain(m.view(), settings, q.outputs(m));
  EXPECT_TRUE(s.ok()) << s.message();
  Errors e{};
  reference::Seen sum;
  int count = 0;
  for (int y = 3; y < m.height; y += 19) {
    for (int x = 5; x < m.width; x += 19) {
      const reference::Seen truth = reference::marched(m, x, y, 720, radius);
      const std::size_t i = std::size_t(y) * m.width + x;
      e.svf += std::fabs(q.svf[i] - truth.svf);
      e.svf_normal += std::fabs(q.svf_normal[i] - truth.svf_normal);
      e.openness += std::fabs(q.openness[i] - truth.openness);
      sum.svf += truth.svf;
      sum.svf_normal += truth.svf_normal;
      ++count;
    }
  }
  return {100 * e.svf / sum.svf, 100 * e.svf_normal / sum.svf_normal, e.openness / count};
}

TEST(TerrainAgreement, RoughReliefIsNearTheMarchedTruth) {
  const Model m = reference::mountains(200, 180, 30, 600);
  const Errors coarse = errors(m, 16), fine = errors(m, 64);
  EXPECT_LT(coarse.svf, 0.4);
  EXPECT_LT(coarse.svf_normal, 0.25);
  EXPECT_LT(coarse.openness, 0.25);
  EXPECT_LT(fine.svf, 0.12);
  EXPECT_LT(fine.svf_normal, 0.08);
  EXPECT_LT(fine.openness, 0.08);
}

TEST(TerrainAgreement, CityIsNearTheMarchedTruth) {
  const Errors e = errors(reference::city(260, 240), 64);
  EXPECT_LT(e.svf, 0.8);
  EXPECT_LT(e.svf_normal, 0.8);
}

TEST(TerrainAgreement, CellsNeedNotBeSquare) {
  for (const auto& cell : {std::array<double, 2>{20, 45}, {70, 30}}) {
    Model m = reference::mountains(150, 150, 30, 600);
    m.cell_width = cell[0];
    m.cell_height = cell[1];
    const Errors e = errors(m, 64);
    EXPECT_LT(e.svf, 0.2);
    EXPECT_LT(e.svf_normal, 0.1);
    EXPECT_LT(e.openness, 0.12);
  }
}

TEST(TerrainAgreement, FiniteRadiiAreNearTheMarchedTruth) {
  const Model m = reference::mountains(150, 150, 30, 600);
  for (const double cells : {10, 20, 50}) {
    const Errors e = errors(m, 64, 30 * cells);
    EXPECT_LT(e.svf, 0.2) << cells;
    EXPECT_LT(e.openness, 0.12) << cells;
  }
}

// Along the axes lines pass through cells: their horizons are those of the cells, exactly, at any
// radius, marched (up to 24 rows) or cut out of chains.
TEST(TerrainAgreement, HorizonsAlongTheAxesAreExactAtAnyRadius) {
  Model m = reference::mountains(131, 157, 10, 300, 0.6);
  for (const int hole : {0, 1}) {
    if (hole) {
      for (int y = 60; y < 90; ++y) {
        for (int x = 50; x < 58; ++x) m(x, y) = std::numeric_limits<float>::quiet_NaN();
      }
    }
    for (const double cells : {1.0, 3.0, 24.0, 25.0, 26.0, 40.0, 100.0, 131.0, 1e9}) {
      TerrainSettings settings;
      settings.azimuths = 4;
      settings.radius = 10 * cells;
      std::vector<std::vector<float>> bands(4, std::vector<float>(m.heights.size()));
      std::vector<ImageView<float>> views;
      for (auto& b : bands) views.emplace_back(b.data(), m.width, m.height);
      TerrainOutputs outputs;
      outputs.horizon = views;
      ASSERT_TRUE(compute_terrain(m.view(), settings, outputs).ok());
      const int dx[] = {0, 1, 0, -1}, dy[] = {-1, 0, 1, 0};
      for (int y = 0; y < m.height; y += 3) {
        for (int x = 0; x < m.width; ++x) {
          for (int k = 0; k < 4; ++k) {
            if (std::isnan(m(x, y))) {
              ASSERT_TRUE(std::isnan(views[k](x, y)));
              continue;
            }
            double best = std::numeric_limits<double>::lowest();
            for (int n = 1; n <= cells; ++n) {
              const int i = x + n * dx[k], j = y + n * dy[k];
              if (i < 0 || j < 0 || i >= m.width || j >= m.height) break;
              if (std::isnan(m(i, j))) continue;
              best = std::max(best, (m(i, j) - m(x, y)) / (10.0 * n));
            }
            const double gamma = best < -1e30 ? 0 : std::atan(best) * 180 / std::numbers::pi;
            ASSERT_NEAR(views[k](x, y), gamma, 0.012)
                << x << "," << y << " towards " << k << ", radius " << cells << ", hole " << hole;
          }
        }
      }
    }
  }
}

// A hill behind a gap in the data is seen across it.
TEST(TerrainAgreement, CellsWithoutDataHideNothing) {
  Model m(200, 200);
  m.fill([](double e, double) { return e > 80 ? 40 : 0; });
  for (int y = 0; y < 200; ++y) {
    for (int x = 120; x < 150; ++x) m(x, y) = y % 3 == 0 ? -9999.0f : y % 3 == 1 ? 1e38f : INFINITY;
  }
  TerrainSettings settings;
  settings.azimuths = 4;
  Quantities q(m);
  ElevationModel model = m.view();
  model.nodata = -9999;
  ASSERT_TRUE(compute_terrain(model, settings, q.outputs(m)).ok());
  const double gamma = std::atan(40.0 / 81);
  EXPECT_NEAR(q.svf[100 * 200 + 100], 1 - std::sin(gamma) / 4, 1e-4);
  EXPECT_TRUE(std::isnan(q.svf[100 * 200 + 130]));
  EXPECT_FLOAT_EQ(q.svf[100 * 200 + 170], float(1 - std::sin(std::atan(40.0 / 11)) / 4));
}

TEST(TerrainAgreement, SmallestModels) {
  for (const auto& size : {std::array<int, 2>{1, 1}, {1, 50}, {50, 1}, {2, 2}}) {
    Model m(size[0], size[1]);
    for (const bool empty : {false, true}) {
      if (empty) std::fill(m.heights.begin(), m.heights.end(), std::nanf(""));
      for (const double radius : {1.5, 30.0, 1e300}) {
        TerrainSettings settings;
        settings.radius = radius;
        Quantities q(m);
        ASSERT_TRUE(compute_terrain(m.view(), settings, q.outputs(m)).ok());
        for (std::size_t i = 0; i < q.svf.size(); ++i) {
          if (empty) {
            ASSERT_TRUE(std::isnan(q.svf[i]) && std::isnan(q.openness[i]));
          } else {
            ASSERT_FLOAT_EQ(q.svf[i], 1);
            ASSERT_FLOAT_EQ(q.svf_normal[i], 1);
            ASSERT_FLOAT_EQ(q.openness[i], 90);
          }
        }
      }
    }
  }
}

TEST(TerrainAgreement, SpikesStayInRange) {
  Model m = reference::mountains(70, 60, 30, 600);
  m(30, 30) = 9e8f;
  m(50, 20) = -9e8f;
  Quantities q(m);
  ASSERT_TRUE(compute_terrain(m.view(), {}, q.outputs(m)).ok());
  for (std::size_t i = 0; i < q.svf.size(); ++i) {
    ASSERT_TRUE(q.svf[i] >= 0 && q.svf[i] <= 1 + 1e-6) << q.svf[i];
    ASSERT_TRUE(q.svf_normal[i] >= -1e-6 && q.svf_normal[i] <= 1 + 1e-6) << q.svf_normal[i];
    ASSERT_TRUE(q.openness[i] >= 0 && q.openness[i] <= 180) << q.openness[i];
  }
}

TEST(TerrainAgreement, MirroredModelsHaveMirroredResults) {
  const Model m = reference::mountains(90, 70, 30, 600);
  Model flipped(90, 70, 30, 30), turned(70, 90, 30, 30);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      flipped(89 - x, y) = m(x, y);
      turned(y, x) = m(x, y);
    }
  }
  Quantities a(m), b(flipped), c(turned);
  ASSERT_TRUE(compute_terrain(m.view(), {}, a.outputs(m)).ok());
  ASSERT_TRUE(compute_terrain(flipped.view(), {}, b.outputs(flipped)).ok());
  ASSERT_TRUE(compute_terrain(turned.view(), {}, c.outputs(turned)).ok());
  double mirrored = 0, transposed = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      const float v = a.svf_normal[y * 90 + x];
      mirrored += std::fabs(v - b.svf_normal[y * 90 + 89 - x]);
      transposed += std::fabs(v - c.svf_normal[x * 70 + y]);
    }
  }
  // Lines are counted from the left, so a mirrored line passes the cells on its other side.
  EXPECT_LT(mirrored / (70 * 90), 3e-3);
  EXPECT_LT(transposed / (70 * 90), 3e-3);
}

TEST(TerrainAgreement, SameBitsForAnyNumberOfThreads) {
  const Model m = reference::mountains(300, 220, 30, 600);
  for (const double radius : {900.0, 1e300}) {
    TerrainSettings settings;
    settings.radius = radius;
    Quantities one(m);
    RunOptions run;
    run.threads = 1;
    ASSERT_TRUE(compute_terrain(m.view(), settings, one.outputs(m), run).ok());
    for (const int threads : {2, 7}) {
      reference::PlainThreads executor(threads);
      run.executor = &executor;
      Quantities many(m);
      ASSERT_TRUE(compute_terrain(m.view(), settings, many.outputs(m), run).ok());
      EXPECT_EQ(one.svf, many.svf);
      EXPECT_EQ(one.svf_normal, many.svf_normal);
      EXPECT_EQ(one.openness, many.openness);
    }
  }
}

TEST(TerrainAgreement, WhatIsWrongIsNamed) {
  const Model m = reference::mountains(20, 20, 30, 600);
  Quantities q(m);
  auto message = [&](auto&& change) {
    ElevationModel model = m.view();
    TerrainSettings settings;
    TerrainOutputs outputs = q.outputs(m);
    change(model, settings, outputs);
    const Status s = compute_terrain(model, settings, outputs);
    EXPECT_FALSE(s.ok());
    return s.message();
  };
  auto expect = [&](const char* what, auto&& change) {
    EXPECT_NE(message(change).find(what), std::string::npos) << message(change);
  };
  expect("heights are missing", [](auto& m, auto&, auto&) { m.heights = {}; });
  expect("cell_width is 0", [](auto& m, auto&, auto&) { m.cell_width = 0; });
  expect("cell_height is nan", [](auto& m, auto&, auto&) { m.cell_height = NAN; });
  expect("azimuths is 0", [](auto&, auto& s, auto&) { s.azimuths = 0; });
  expect("radius is 12; it must reach", [](auto&, auto& s, auto&) { s.radius = 12; });
  expect("refraction is 1", [](auto&, auto& s, auto&) { s.refraction = 1; });
  expect("z_factor is 0", [](auto&, auto& s, auto&) { s.z_factor = 0; });
  expect("svf is 20x19", [](auto&, auto&, auto& o) { o.svf.height = 19; });
  expect("outputs are all empty", [](auto&, auto&, auto& o) { o = {}; });
  std::vector<ImageView<float>> bands(3, q.outputs(m).svf);
  expect("horizon has 3 images", [&](auto&, auto&, auto& o) { o.horizon = bands; });
}

TEST(TerrainAgreement, ProgressRisesAndMayStop) {
  const Model m = reference::mountains(64, 64, 30, 600);
  Quantities q(m);
  RunOptions run;
  double last = 0;
  run.progress = [&](double share) {
    EXPECT_GE(share, last);
    last = share;
    return true;
  };
  ASSERT_TRUE(compute_terrain(m.view(), {}, q.outputs(m), run).ok());
  EXPECT_DOUBLE_EQ(last, 1);
  run.progress = [](double) { return false; };
  EXPECT_EQ(compute_terrain(m.view(), {}, q.outputs(m), run).code(), StatusCode::kCancelled);
}

}  // namespace
}  // namespace obscura
