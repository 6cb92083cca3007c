#include <gtest/gtest.h>

#include <cmath>

#include "obscura/terrain.h"
#include "tests/reference/terrain.h"

// Quantities of archaeologists, and cells of geographic grids.
namespace obscura {
namespace {

using reference::Model;
constexpr double kPi = std::numbers::pi;

std::vector<float> computed(const ElevationModel& model, const TerrainSettings& settings,
                            ImageView<float> TerrainOutputs::*quantity) {
  std::vector<float> values(std::size_t(model.heights.width) * model.heights.height, -1);
  TerrainOutputs outputs;
  outputs.*quantity = {values.data(), model.heights.width, model.heights.height};
  const Status s = compute_terrain(model, settings, outputs);
  EXPECT_TRUE(s.ok()) << s.message();
  return values;
}

// A ridge to the north hides the sky there: it costs more where more light comes from.
TEST(TerrainRelief, AnisotropicSkyViewFactorWeighsAzimuths) {
  Model m(201, 81);
  m.fill([](double, double n) { return n >= 20 ? 20 : 0; });
  for (const Anisotropy level : {Anisotropy::kLow, Anisotropy::kHigh}) {
    for (const double direction : {0.0, 90.0, 180.0, 315.0}) {
      TerrainSettings settings;
      settings.azimuths = 32;
      settings.asvf_direction = direction;
      settings.asvf_level = level;
      const float asvf = computed(m.view(), settings, &TerrainOutputs::asvf)[40 * 201 + 100];
      double sum = 0, weights = 0;
      const double least = level == Anisotropy::kHigh ? 0.1 : 0.4;
      for (int k = 0; k < 32; ++k) {
        const double phi = 2 * kPi * k / 32;
        const double c = std::cos((phi - direction * kPi / 180) / 2);
        const double w = least + (1 - least) * std::pow(c, level == Anisotropy::kHigh ? 8 : 4);
        const double t = reference::marched_slope(m, 100, 40, phi, 1e9);
        sum += w * (1 - std::sin(std::atan(std::max(t, 0.0))));
        weights += w;
      }
      EXPECT_NEAR(asvf, sum / weights, 4e-3) << direction;
    }
  }
}

TEST(TerrainRelief, LocalDominanceIsThatOfPlainLoops) {
  Model m = reference::mountains(70, 60, 1, 20);
  m(40, 30) = NAN;
  TerrainSettings settings;
  const std::vector<float> values = computed(m.view(), settings, &TerrainOutputs::local_dominance);
  for (int y = 0; y < 60; y += 7) {
    for (int x = 0; x < 70; x += 3) {
      double sum = 0, flat = 0;
      for (int angle = 0; angle < 360; angle += 15) {
        for (int d = 10; d <= 20; ++d) {
          const int i = x + int(std::nearbyint(d * std::cos(angle * kPi / 180)));
          const int j = y + int(std::nearbyint(d * std::sin(angle * kPi / 180)));
          if (i < 0 || j < 0 || i >= 70 || j >= 60 || std::isnan(m(i, j))) continue;
          sum += std::max(0.0, m(x, y) + 1.7 - m(i, j)) / d * (2 * d + 1);
          flat += 1.7 / d * (2 * d + 1);
        }
      }
      ASSERT_NEAR(values[y * 70 + x], sum / flat, 1e-4 * (1 + sum / flat)) << x << "," << y;
    }
  }
}

TEST(TerrainRelief, LocalDominanceOfFlatGroundAndOfAMound) {
  Model m(61, 61);
  m(30, 30) = 17;
  const std::vector<float> values = computed(m.view(), {}, &TerrainOutputs::local_dominance);
  EXPECT_FLOAT_EQ(values[5 * 61 + 5], 1);
  EXPECT_NEAR(values[30 * 61 + 30], 11, 1e-4);  // (17 + 1.7) / 1.7
}

// Rows of equal widths are those of a plain grid, and rows that narrow are near those of their own.
TEST(TerrainRelief, RowsMayHaveWidthsOfTheirOwn) {
  const Model m = reference::mountains(90, 80, 30, 600);
  TerrainSettings settings;
  ElevationModel model = m.view();
  const std::vector<float> plain = computed(model, settings, &TerrainOutputs::svf_normal);
  std::vector<double> widths(80, 30.0);
  model.row_widths = widths;
  EXPECT_EQ(computed(model, settings, &TerrainOutputs::svf_normal), plain);
  for (int y = 0; y < 80; ++y) widths[y] = 20 + 0.1 * y;
  const std::vector<float> narrowing = computed(model, settings, &TerrainOutputs::svf_normal);
  for (const int y : {0, 25, 79}) {
    ElevationModel own = m.view();
    own.cell_width = widths[y];
    const std::vector<float> expected = computed(own, settings, &TerrainOutputs::svf_normal);
    for (int x = 0; x < 90; ++x) {
      ASSERT_NEAR(narrowing[y * 90 + x], expected[y * 90 + x], 0.012) << x << "," << y;
    }
  }
  widths.pop_back();
  model.row_widths = widths;
  std::vector<float> out(m.heights.size());
  TerrainOutputs outputs;
  outputs.svf = {out.data(), 90, 80};
  EXPECT_EQ(compute_terrain(model, settings, outputs).code(), StatusCode::kInvalidInput);
}

TEST(TerrainRelief, RingsAreChecked) {
  const Model m(9, 9);
  std::vector<float> out(81);
  TerrainOutputs outputs;
  outputs.local_dominance = {out.data(), 9, 9};
  TerrainSettings settings;
  settings.dominance_from = 5;
  settings.dominance_to = 4;
  const Status s = compute_terrain(m.view(), settings, outputs);
  EXPECT_NE(s.message().find("dominance_to is 4"), std::string::npos) << s.message();
}

}  // namespace
}  // namespace obscura
