#ifndef OBSCURA_BENCH_SLAB_TABLE_H_
#define OBSCURA_BENCH_SLAB_TABLE_H_

#include <vector>

#include "math/falloff.h"

namespace obscura::bench {

// The integral over a piece of an azimuthal slice from tables: two functions of three variables,
// Lc and Ls, the integrals from 0 to a of rho(b / |sin(t - c)|) times cos t sin t and sin^2 t. They
// are linear in a and c, over [0, pi], and in sqrt(b / (b + R)).
struct SlabTable {
  SlabTable(const math::Rho& rho, int size);

  int size;
  float radius;
  std::vector<float> pairs;  // Lc, Ls; a runs fastest, then c, then b
};

// Many slices, point by point: the i-th point of slice s is (x, y)[i * count + s], x < 0 where
// there is none. In the slice's frame (math/slice_leaf.h).
struct SliceSet {
  int count = 0, points = 0;
  std::vector<float> x, y, nz, nt, camera;
};

// Obscurance of each slice, slabs, by Gauss points in registers as the far field does, or
// by the table where one is given.
void evaluate_slices(const math::Rho& rho, const SlabTable* table, const SliceSet& set, float* out);

}  // namespace obscura::bench

#endif  // OBSCURA_BENCH_SLAB_TABLE_H_
