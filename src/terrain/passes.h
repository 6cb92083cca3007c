#ifndef OBSCURA_SRC_TERRAIN_PASSES_H_
#define OBSCURA_SRC_TERRAIN_PASSES_H_

#include <vector>

#include "obscura/terrain.h"
#include "terrain/sweep_kernel.h"

namespace obscura {

// A quantity is start + factor * the mean over the azimuths of its sum's terms, in [least, most].
struct TerrainWanted {
  TerrainSum sum;
  ImageView<float> view;
  double start, factor, least, most;
};

// A pass over the model as it is, or turned upside down.
struct TerrainPass {
  float sign = 1;
  std::vector<TerrainWanted> wanted;
  bool horizon = false, dominance = false;

  bool sweeps() const { return horizon || !wanted.empty(); }
};
std::vector<TerrainPass> terrain_passes(const TerrainOutputs& outputs);

// Rows of a model whose cells are taken to be as wide as each other.
struct TerrainLatitudes {
  int begin, end;
  double cell_width;
};
// Of the rows from `begin` to `end`.
std::vector<TerrainLatitudes> terrain_latitudes(const ElevationModel& model, int begin, int end);

// Sweeps in the order in which their sums are added: those downwards before those upwards, so that
// bands of a model can be computed in that order, too.
struct TerrainStep {
  bool transposed, up, first, last;
};
inline constexpr TerrainStep kTerrainSteps[] = {{false, false, true, false},
                                                {true, false, false, false},
                                                {true, true, false, false},
                                                {false, true, false, true}};

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_PASSES_H_
