#ifndef OBSCURA_SRC_TERRAIN_DIRECTIONS_H_
#define OBSCURA_SRC_TERRAIN_DIRECTIONS_H_

#include <limits>
#include <vector>

#include "obscura/terrain.h"
#include "terrain/sweep_kernel.h"

namespace obscura {

// How lines run towards one azimuth. Directions that cross more columns than rows are swept on the
// transposed grid.
struct TerrainDirection {
  int index = 0;  // among the azimuths
  bool transposed = false;
  // Without pointers into a grid; near samples and rows are those below.
  TerrainSweep sweep;
  std::vector<NearSample> near;
  std::vector<float> row_offset, row_slope;
  double step = 1;                                         // world units from row to row
  double earth = std::numeric_limits<double>::infinity();  // its radius, with refraction

  // What is added to heights in a swept row, of the grid or before it, for a round earth.
  double offset(int row) const {
    const double y = position(row);
    return -y * y / (2 * earth);
  }
  // Along the sweep, from the middle row.
  double position(int row) const { return (row - 0.5 * (sweep.height - 1)) * step; }
};

// The directions of all azimuths over a model of this size, whose cells have this width.
std::vector<TerrainDirection> terrain_directions(const ElevationModel& model, double cell_width,
                                                 const TerrainSettings& settings);

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_DIRECTIONS_H_
