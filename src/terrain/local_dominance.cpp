#include "terrain/local_dominance.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace obscura {

DominanceRing::DominanceRing(const TerrainSettings& settings)
    : observer_(static_cast<float>(settings.observer_height)) {
  constexpr int kDegrees = 15;
  for (int angle = 0; angle < 360; angle += kDegrees) {
    const double phi = angle * std::numbers::pi / 180;
    for (int d = settings.dominance_from; d <= settings.dominance_to; ++d) {
      // Halves are rounded to even, as NumPy rounds them.
      cells_.push_back({static_cast<int>(std::nearbyint(d * std::cos(phi))),
                        static_cast<int>(std::nearbyint(d * std::sin(phi))),
                        static_cast<float>(2 * d + 1) / static_cast<float>(d)});
    }
  }
}

void DominanceRing::row(const TerrainPlane& heights, int y, int x0, int x1,
                        float* dominance) const {
  static_assert(60 <= kTerrainMargin);
  float sum[kTerrainTile] = {}, flat[kTerrainTile] = {};
  const int count = x1 - x0;
  const float* own = heights.row(y) + x0;
  for (const Cell& cell : cells_) {
    // Margins have no data, or the rows around a band.
    if (y + cell.y < -heights.margin()) continue;
    if (y + cell.y >= heights.height() + heights.margin()) continue;
    const float* other = heights.row(y + cell.y) + x0 + cell.x;
    for (int i = 0; i < count; ++i) {
      const float weight = other[i] > kChainEnd ? cell.weight : 0.0f;
      const float above = own[i] + observer_ - other[i];
      sum[i] += weight * (above > 0 ? above : 0.0f);
      flat[i] += weight * observer_;
    }
  }
  for (int i = 0; i < count; ++i) {
    dominance[i] = flat[i] > 0 ? sum[i] / flat[i] : std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace obscura
