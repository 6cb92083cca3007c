#ifndef OBSCURA_SRC_TERRAIN_SURROUND_H_
#define OBSCURA_SRC_TERRAIN_SURROUND_H_

#include <vector>

#include "obscura/terrain.h"
#include "terrain/directions.h"
#include "terrain/sweep_kernel.h"

namespace obscura {

// What lines towards one azimuth cross of a coarse surround before they enter a tile: a sample
// every `factor` rows.
class SurroundLines final : public LineEntries {
 public:
  // One list per worker, with room for a point every factor rows.
  using Points = std::vector<std::vector<LinePoint>>;

  // Heights become factor * (height - base), as the tile's.
  SurroundLines(const ElevationModel& model, const TerrainDirection& direction, double factor,
                double base, Points* points)
      : model_(model), direction_(direction), factor_(factor), base_(base), points_(*points) {}

  std::span<const LinePoint> before(int column, int entry, int worker) override;

 private:
  // Of the coarse model, in the tile's swept grid; false outside it.
  bool coarse_position(double column, int row, double* x, double* y) const;
  float height_at(double x, double y) const;  // NaN: none

  const ElevationModel& model_;
  const TerrainDirection& direction_;
  const double factor_, base_;
  Points& points_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_SURROUND_H_
