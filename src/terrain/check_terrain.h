#ifndef OBSCURA_SRC_TERRAIN_CHECK_TERRAIN_H_
#define OBSCURA_SRC_TERRAIN_CHECK_TERRAIN_H_

#include <cmath>
#include <optional>

#include "obscura/terrain.h"

namespace obscura {

// `rows`: of the whole model, where the model is a band of it; each has a width.
Status check_terrain(const ElevationModel& model, const TerrainSettings& settings,
                     const TerrainOutputs& outputs, std::optional<int> rows = {});
Status check_terrain_band(const ElevationModel& model, const TerrainBand& band,
                          const TerrainSettings& settings, const TerrainOutputs& outputs);

inline bool has_height(const ElevationModel& model, float height) {
  return std::fabs(height) <= kMostTerrainHeight && !(model.nodata && height == *model.nodata);
}

// Where results are wanted.
inline TerrainWindow inner_of(const ElevationModel& model) {
  if (model.inner.width > 0) return model.inner;
  return {0, 0, model.heights.width, model.heights.height};
}

// Of the first cell that has one, in rows; 0 if none has.
double first_height(const ElevationModel& model);

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_CHECK_TERRAIN_H_
