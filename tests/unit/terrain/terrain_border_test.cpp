#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "obscura/terrain.h"
#include "tests/reference/terrain.h"

// Cells beside the border of a model, and beside cells without data.
namespace obscura {
namespace {

using reference::Model;

// One image per azimuth.
std::vector<std::vector<float>> horizons(const Model& m, int azimuths) {
  std::vector<std::vector<float>> bands(azimuths, std::vector<float>(m.heights.size()));
  std::vector<ImageView<float>> views;
  for (auto& b : bands) views.emplace_back(b.data(), m.width, m.height);
  TerrainSettings settings;
  settings.azimuths = azimuths;
  TerrainOutputs outputs;
  outputs.horizon = views;
  const Status s = compute_terrain(m.view(), settings, outputs);
  EXPECT_TRUE(s.ok()) << s.message();
  return bands;
}

// Diagonals pass through cells, but the tangent of 45 degrees is 1 only but for rounding. A wall
// along the border hides the sky up to the angle of its cell on the diagonal. Holes stand where the
// border is, so that samples beside the wall have no data.
TEST(TerrainBorder, WallsOnTheBorderAreSeenAlongDiagonals) {
  constexpr int kSide = 40;
  for (const bool hole : {false, true}) {
    const int border = hole ? 12 : 0;
    for (const int azimuths : {8, 16, 24, 40, 72, 120, 360}) {
      // The wall is on the west, north, east and south.
      for (int side = 0; side < 4; ++side) {
        Model m(kSide, kSide);
        auto cell = [&](int from_wall, int along) -> float& {
          const int last = kSide - 1;
          switch (side) {
            case 0:
              return m(from_wall, along);
            case 1:
              return m(along, from_wall);
            case 2:
              return m(last - from_wall, along);
            default:
              return m(along, last - from_wall);
          }
        };
        for (int along = 0; along < kSide; ++along) {
          for (int i = 0; i < border; ++i) cell(i, along) = std::numeric_limits<float>::quiet_NaN();
          cell(border, along) = 10;
        }
        const auto bands = horizons(m, azimuths);
        // From the wall's side of the sky, 45 degrees to the left and to the right.
        const int straight[] = {270, 0, 90, 180};
        for (const int turn : {-45, 45}) {
          const int azimuth = (straight[side] + turn + 360) % 360;
          const auto& band = bands[azimuth * azimuths / 360];
          for (int d = 1; d <= 8; ++d) {
            const float* at = &cell(border + d, kSide / 2);
            const double expected =
                std::atan(10 / (d * std::numbers::sqrt2)) * 180 / std::numbers::pi;
            EXPECT_NEAR(band[at - m.heights.data()], expected, 0.01)
                << azimuths << " azimuths, towards " << azimuth << ", " << d << " cells away";
          }
        }
      }
    }
  }
}

// Beside the border as elsewhere: what is seen there is that of the model alone, 9 degrees more
// open than the same cells with the land beyond, and nothing the sweeps add. Cells reach half a
// cell beyond their centres, where the march ends.
TEST(TerrainBorder, BorderCellsAreNearTheMarchedTruth) {
  const Model m = reference::mountains(120, 120, 30, 1200);
  TerrainSettings settings;
  settings.azimuths = 64;
  std::vector<float> openness(m.heights.size()), svf(m.heights.size());
  TerrainOutputs outputs;
  outputs.openness = {openness.data(), m.width, m.height};
  outputs.svf = {svf.data(), m.width, m.height};
  ASSERT_TRUE(compute_terrain(m.view(), settings, outputs).ok());
  for (const int from_border : {0, 1, 2, 5, 40}) {
    double difference[2] = {}, mean = 0;
    int count = 0;
    const int last = 119 - from_border;
    for (int i = from_border; i <= last; i += 3) {
      for (const auto& cell :
           {std::array{i, from_border}, {i, last}, {from_border, i}, {last, i}}) {
        const reference::Seen truth = reference::marched(m, cell[0], cell[1], 64);
        const std::size_t at = std::size_t(cell[1]) * m.width + cell[0];
        difference[0] += std::fabs(openness[at] - truth.openness);
        difference[1] += std::fabs(svf[at] - truth.svf);
        mean += truth.svf;
        ++count;
      }
    }
    EXPECT_LT(difference[0] / count, 0.2) << from_border;
    EXPECT_LT(difference[1] / mean, 0.0025) << from_border;
  }
}

}  // namespace
}  // namespace obscura
