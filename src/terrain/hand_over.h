#ifndef OBSCURA_SRC_TERRAIN_HAND_OVER_H_
#define OBSCURA_SRC_TERRAIN_HAND_OVER_H_

#include <atomic>
#include <vector>

#include "obscura/terrain.h"
#include "terrain/directions.h"
#include "terrain/sweep_kernel.h"

namespace obscura {

// Lines towards one azimuth that run through a band of a model: taken over from the band before,
// handed on to the one after. What crosses a border between bands does so in a column of the model,
// each line in one of its own.
class HandOver final : public LineEntries {
 public:
  using Points = std::vector<std::vector<LinePoint>>;  // by worker

  // Null: no band before, or after.
  HandOver(const TerrainDirection& direction, TerrainHulls* from, TerrainHulls* to, Points* points)
      : direction_(direction), from_(from), to_(to), points_(*points) {}

  std::span<const LinePoint> before(int column, int entry, int worker) override;
  bool wants_last_row() const override { return to_ && !direction_.transposed; }
  bool wants_sides() const override { return to_ && direction_.transposed; }
  void leave(int row, int x, std::span<const LinePoint> hull, int worker) override;

  // The first failure, once no thread sweeps any more.
  Status status() const { return status_; }

 private:
  void fail(const Status& status);
  // Rows of the whole model before the grid's first, in the order of the sweep.
  int first_row() const { return direction_.sweep.first_row; }

  const TerrainDirection& direction_;
  TerrainHulls *from_, *to_;
  Points& points_;
  std::atomic<bool> failed_{false};
  Status status_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_HAND_OVER_H_
