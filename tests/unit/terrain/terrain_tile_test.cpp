#include <gtest/gtest.h>

#include <cmath>

#include "obscura/terrain.h"
#include "tests/reference/terrain.h"

// Tiles of a model against the whole.
namespace obscura {
namespace {

using reference::Model;

struct Results {
  std::vector<float> svf, openness, horizon;
};

Results computed(const ElevationModel& model, TerrainSettings settings) {
  const bool inner = model.inner.width > 0;
  const int width = inner ? model.inner.width : model.heights.width;
  const int height = inner ? model.inner.height : model.heights.height;
  Results r;
  std::vector<std::vector<float>> bands(settings.azimuths);
  std::vector<ImageView<float>> views;
  for (auto* v : {&r.svf, &r.openness}) v->resize(std::size_t(width) * height);
  for (auto& b : bands) {
    b.resize(r.svf.size());
    views.emplace_back(b.data(), width, height);
  }
  TerrainOutputs outputs;
  outputs.svf = {r.svf.data(), width, height};
  outputs.openness = {r.openness.data(), width, height};
  outputs.horizon = views;
  const Status s = compute_terrain(model, settings, outputs);
  EXPECT_TRUE(s.ok()) << s.message();
  for (const auto& b : bands) r.horizon.insert(r.horizon.end(), b.begin(), b.end());
  return r;
}

// A tile at (x, y) of `size` cells, with a halo cut off at the model's border.
struct Tile {
  Tile(const Model& m, int x, int y, int size, int halo, int factor)
      : coarse(std::size_t((m.width + factor - 1) / factor) * ((m.height + factor - 1) / factor)) {
    const ImageView<float> out(coarse.data(), (m.width + factor - 1) / factor,
                               (m.height + factor - 1) / factor);
    EXPECT_TRUE(coarsen_terrain(m.view(), factor, out).ok());
    const int x0 = std::max(0, x - halo), y0 = std::max(0, y - halo);
    const int x1 = std::min(m.width, x + size + halo), y1 = std::min(m.height, y + size + halo);
    model = m.view();
    model.heights = {m.heights.data() + std::size_t(y0) * m.width + x0, x1 - x0, y1 - y0, m.width};
    model.inner = {x - x0, y - y0, size, size};
    model.surround.heights = out;
    model.surround.factor = factor;
    model.surround.width = m.width;
    model.surround.height = m.height;
    model.surround.column = x0;
    model.surround.row = y0;
  }
  std::vector<float> coarse;
  ElevationModel model;
};

// Mean difference of a tile's svf from the whole's, in percent.
double error(const Model& m, const Results& whole, const Results& tile, int x, int y, int size) {
  double sum = 0, difference = 0;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const float v = whole.svf[std::size_t(y + j) * m.width + x + i];
      sum += v;
      difference += std::fabs(v - tile.svf[std::size_t(j) * size + i]);
    }
  }
  return 100 * difference / sum;
}

TEST(TerrainTile, HaloAloneIsTheWholeWhereItReachesTheBorder) {
  const Model m = reference::mountains(150, 130, 30, 600);
  for (const double radius : {600.0, 1200.0, 1e300}) {
    TerrainSettings settings;
    settings.radius = radius;
    const Results whole = computed(m.view(), settings);
    ElevationModel model = m.view();
    model.inner = {40, 37, 50, 44};
    const Results part = computed(model, settings);
    for (int y = 0; y < 44; ++y) {
      for (int x = 0; x < 50; ++x) {
        ASSERT_EQ(part.svf[y * 50 + x], whole.svf[(37 + y) * 150 + 40 + x]);
        ASSERT_EQ(part.openness[y * 50 + x], whole.openness[(37 + y) * 150 + 40 + x]);
      }
    }
  }
}

// With finite radii, on flat and round earths and on geographic grids, beside holes.
TEST(TerrainTile, HaloOfTheRadiusHasTheBitsOfTheWhole) {
  Model m = reference::mountains(300, 260, 30, 600);
  m.cell_height = 40;
  for (int y = 100; y < 130; ++y) {
    for (int x = 90; x < 99; ++x) m(x, y) = std::numeric_limits<float>::quiet_NaN();
  }
  std::vector<double> widths;
  for (int y = 0; y < 260; ++y) widths.push_back(30 * std::cos(0.9 + 0.0004 * y));
  for (const double radius : {300.0, 900.0, 1230.0, 3000.0, 9000.0}) {
    for (const int kind : {0, 1, 2}) {
      TerrainSettings settings;
      settings.radius = radius;
      settings.curvature = kind == 1;
      ElevationModel all = m.view();
      all.datum = 12.5;
      if (kind == 2) all.row_widths = widths;
      const Results whole = computed(all, settings);
      const int halo = int(std::ceil(radius / (kind == 2 ? widths.back() : 30))) + 1, size = 60;
      for (const auto& at : {std::array{0, 0}, {75, 101}, {240, 200}, {103, 0}}) {
        const int x = at[0], y = at[1];
        const int x0 = std::max(0, x - halo), y0 = std::max(0, y - halo);
        const int x1 = std::min(m.width, x + size + halo);
        const int y1 = std::min(m.height, y + size + halo);
        ElevationModel tile = all;
        tile.heights = {m.heights.data() + std::size_t(y0) * m.width + x0, x1 - x0, y1 - y0,
                        m.width};
        tile.inner = {x - x0, y - y0, size, size};
        tile.surround.width = m.width;
        tile.surround.height = m.height;
        tile.surround.column = x0;
        tile.surround.row = y0;
        const Results part = computed(tile, settings);
        int different = 0;
        for (int j = 0; j < size; ++j) {
          for (int i = 0; i < size; ++i) {
            const std::size_t of_whole = std::size_t(y + j) * m.width + x + i;
            const float a = part.openness[j * size + i], b = whole.openness[of_whole];
            different += !(a == b || (std::isnan(a) && std::isnan(b)));
          }
        }
        EXPECT_EQ(different, 0) << radius << " " << kind << " at " << x << "," << y;
      }
    }
  }
}

// A surround as fine as the model gives the whole's horizons: lines bring along what they crossed.
TEST(TerrainTile, FineSurroundGivesTheWhole) {
  const Model m = reference::mountains(150, 130, 30, 600);
  for (const bool round : {false, true}) {
    TerrainSettings settings;
    settings.curvature = round;
    const Results whole = computed(m.view(), settings);
    const int size = 30, x = 70, y = 50;
    const Tile tile(m, x, y, size, 12, 1);
    const Results part = computed(tile.model, settings);
    int far = 0;
    for (int k = 0; k < settings.azimuths; ++k) {
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
          const float a = part.horizon[std::size_t(k * size + j) * size + i];
          const float b = whole.horizon[std::size_t(k * m.height + y + j) * m.width + x + i];
          far += std::fabs(a - b) > 0.02f;
        }
      }
    }
    EXPECT_LT(far, 0.02 * settings.azimuths * size * size);
    EXPECT_LT(error(m, whole, part, x, y, size), 0.01);
  }
}

// A halo of h cells with blocks of h / 8.
TEST(TerrainTile, CoarseSurroundIsNearTheWhole) {
  const Model m = reference::mountains(420, 420, 30, 900);
  const Results whole = computed(m.view(), {});
  double sum = 0;
  for (const int x : {0, 180, 324}) {
    const int size = 96;
    const Tile tile(m, x, 150, size, 64, 8);
    ElevationModel cut = tile.model;
    cut.surround = {};
    const double around = error(m, whole, computed(tile.model, {}), x, 150, size);
    EXPECT_LT(around, 0.08) << x;
    sum += around;
    // The checker sees what a halo alone loses.
    EXPECT_GT(error(m, whole, computed(cut, {}), x, 150, size), 4 * around) << x;
  }
  EXPECT_LT(sum / 3, 0.05);
}

TEST(TerrainTile, CoarseCellsAreHalfWayToTheHighest) {
  Model m(5, 3);
  m.heights = {1, 2, 3,   4,   9,  //
               1, 2, 3,   NAN, 9,  //
               7, 7, NAN, NAN, 5};
  std::vector<float> coarse(6);
  ASSERT_TRUE(coarsen_terrain(m.view(), 2, {coarse.data(), 3, 2}).ok());
  EXPECT_FLOAT_EQ(coarse[0], 1.75f);
  EXPECT_FLOAT_EQ(coarse[1], 0.5f * (4 + 10.0f / 3));
  EXPECT_FLOAT_EQ(coarse[2], 9);
  EXPECT_FLOAT_EQ(coarse[3], 7);
  EXPECT_TRUE(std::isnan(coarse[4]));
  EXPECT_FLOAT_EQ(coarse[5], 5);
  EXPECT_FALSE(coarsen_terrain(m.view(), 2, {coarse.data(), 2, 2}).ok());
  EXPECT_FALSE(coarsen_terrain(m.view(), 0, {coarse.data(), 3, 2}).ok());
}

TEST(TerrainTile, WhatIsWrongIsNamed) {
  const Model m = reference::mountains(40, 40, 30, 600);
  Tile tile(m, 10, 10, 20, 5, 4);
  std::vector<float> out(400);
  auto expect = [&](const char* part, auto&& change) {
    ElevationModel model = tile.model;
    TerrainSettings settings;
    change(model, settings);
    TerrainOutputs outputs;
    outputs.svf = {out.data(), 20, 20};
    const Status s = compute_terrain(model, settings, outputs);
    EXPECT_NE(s.message().find(part), std::string::npos) << s.message();
  };
  expect("inner is 20x20 at 11,5", [](auto& m, auto&) { m.inner.x = 11; });
  expect("surround.heights need a radius of infinity", [](auto&, auto& s) { s.radius = 300; });
  expect("surround.factor is 0", [](auto& m, auto&) { m.surround.factor = 0; });
  expect("must lie within", [](auto& m, auto&) { m.surround.column = 30; });
  expect("svf is 20x20; it must be as large as what is wanted of the model, 21x20",
         [](auto& m, auto&) { m.inner.width = 21; });
}

}  // namespace
}  // namespace obscura
