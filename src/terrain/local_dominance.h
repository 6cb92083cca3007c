#ifndef OBSCURA_SRC_TERRAIN_LOCAL_DOMINANCE_H_
#define OBSCURA_SRC_TERRAIN_LOCAL_DOMINANCE_H_

#include <vector>

#include "obscura/terrain.h"
#include "terrain/plane.h"

namespace obscura {

// The ring of cells that local dominance looks at.
class DominanceRing {
 public:
  // Whose radii fit into a plane's margin.
  explicit DominanceRing(const TerrainSettings& settings);

  // One row, from columns x0 to x1, within a tile. Cells of the ring that lie outside or have no
  // data do not count.
  void row(const TerrainPlane& heights, int y, int x0, int x1, float* dominance) const;

 private:
  struct Cell {
    int x, y;
    float weight;
  };
  std::vector<Cell> cells_;
  float observer_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_LOCAL_DOMINANCE_H_
