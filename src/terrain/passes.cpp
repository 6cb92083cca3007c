#include "terrain/passes.h"

#include <algorithm>
#include <numbers>

namespace obscura {

std::vector<TerrainPass> terrain_passes(const TerrainOutputs& o) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  TerrainPass up, down;
  down.sign = -1;
  auto want = [](TerrainPass& pass, TerrainSum sum, const ImageView<float>& view, double start,
                 double factor, double most) {
    if (!view.empty()) pass.wanted.push_back({sum, view, start, factor, 0, most});
  };
  want(up, kSumSvf, o.svf, 0, 1, 1);
  want(up, kSumSvfNormal, o.svf_normal, 0, 1, 1);
  want(up, kSumSvfCosine, o.svf_cosine, 0, 1, 1);
  want(up, kSumOpenness, o.openness, 90, -kDegrees, 180);
  want(up, kSumVisibleSky, o.visible_sky, 100, -100 * 2 / std::numbers::pi, 100);
  want(up, kSumAsvf, o.asvf, 0, 1, 1);
  up.horizon = !o.horizon.empty();
  up.dominance = !o.local_dominance.empty();
  want(down, kSumOpenness, o.negative_openness, 90, -kDegrees, 180);
  std::vector<TerrainPass> passes;
  if (up.dominance || up.sweeps()) passes.push_back(std::move(up));
  if (!down.wanted.empty()) passes.push_back(std::move(down));
  return passes;
}

std::vector<TerrainLatitudes> terrain_latitudes(const ElevationModel& model, int begin, int end) {
  if (model.row_widths.empty()) return {{begin, end, model.cell_width}};
  constexpr double kSpread = 1.02;
  std::vector<TerrainLatitudes> latitudes;
  for (int y = begin; y < end;) {
    double least = model.row_widths[y], most = least;
    int next = y;
    for (; next < end; ++next) {
      const double low = std::min(least, model.row_widths[next]);
      const double high = std::max(most, model.row_widths[next]);
      if (high > kSpread * low) break;
      least = low;
      most = high;
    }
    latitudes.push_back({y, next, 0.5 * (least + most)});
    y = next;
  }
  return latitudes;
}

}  // namespace obscura
