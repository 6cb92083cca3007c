#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SHARE_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SHARE_H_

#include <algorithm>
#include <cstdint>

#include "screen/far_field/directions.h"
#include "screen/far_field/totals.h"

// Work shared by groups of n x n pixels (Timonen 2013, section 10, there the far field alone, of 3
// x 3): each evaluates its share of the directions, near and far, and takes the others from its
// neighbours that see the same surface, weighted by how far each lies from the other's plane. Tiles
// where many pixels have no such neighbours, as in foliage, evaluate n times as many directions.
// The formulas: share_leaf.h.
namespace obscura::far_field {

// Tiles are squares of this many pixels, so that their rows are whole vectors of each phase.
constexpr int tile_of_phases(int phases) { return 16 * phases; }
inline constexpr int kKnownStep = 2;  // rows of a tile that its density is judged by

class SharedWork {
 public:
  // Groups of side x side pixels, of which a row's receivers lie in `phases` (phases_of()).
  SharedWork(int side, int phases) : side_(side), phases_(phases), tile_(tile_of_phases(phases)) {}

  // Decides which tiles are dense.
  void prepare(const view::Geometry& geometry, Executor& executor);

  // Calls run(begin, end) for the receivers that evaluate a direction, of `count` of one phase in
  // row y of the direction's plane. `cell` is theirs, row by row of the group.
  template <class Run>
  void for_receivers(const Direction& direction, int cell, int y, int count, const Run& run) const {
    const Who who = evaluates(cell, direction.share);
    if (who == Who::kAll) run(0, count);
    if (who != Who::kDense) return;
    const AlignedImage<std::uint8_t>& tiles = dense_[direction.transposed];
    const std::uint8_t* row = tiles.row(y / tile_);
    const int vector = tile_ / phases_;
    for (int t = 0, end; t < tiles.width(); t = end + 1) {
      for (end = t; end < tiles.width() && row[end] != 0;) ++end;
      if (t < end && t * vector < count) run(t * vector, std::min(count, end * vector));
    }
  }

  // From each pixel's own slices to all of them. Results are made in `spare`, then swapped.
  void gather(const view::Geometry& geometry, const WantedSums& wanted, Executor& executor,
              Totals* totals, Totals* spare) const;

 private:
  enum class Who { kNone, kDense, kAll };
  Who evaluates(int cell, int share) const;

  const int side_, phases_, tile_;
  AlignedImage<std::uint8_t> dense_[2];  // as the image lies, and transposed
};

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SHARE_H_
