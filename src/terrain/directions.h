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
  int whole_rows = 0;                                      // swept rows of the whole model
  double step = 1;                                         // world units from row to row
  double earth = std::numeric_limits<double>::infinity();  // its radius, with refraction

  // What is added to heights in a swept row of the whole model, for a round earth.
  double offset(int row) const {
    const double y = position(row);
    return -y * y / (2 * earth);
  }
  // Along the sweep, from the middle row.
  double position(int row) const { return (row - 0.5 * (whole_rows - 1)) * step; }
  // Whether lines come from southern rows.
  bool up() const { return transposed ? sweep.shear < 0 : sweep.reversed; }
};

// The directions of all azimuths over a model of this size, whose cells have these sides.
std::vector<TerrainDirection> terrain_directions(Extent size, double cell_width, double cell_height,
                                                 const TerrainSettings& settings);

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_DIRECTIONS_H_
