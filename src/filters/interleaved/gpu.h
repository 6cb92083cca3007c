#ifndef OBSCURA_SRC_FILTERS_INTERLEAVED_GPU_H_
#define OBSCURA_SRC_FILTERS_INTERLEAVED_GPU_H_

#include "gpu/program.h"
#include "gpu/visibility_target.h"

namespace obscura::gpu {

// Sums of an interleaved pattern, per visible pixel; -1: none.
struct SumRegions {
  int open = -1;        // float: the visibility where `directions` has another open share, or none
  int directions = -1;  // vec4: the difference to the normal's share, and the open share

  // The region that is there, for bindings that a pass is specialised not to touch.
  int any() const { return directions >= 0 ? directions : open; }
};
SumRegions add_sums(const Frame& frame, bool open, bool directions, Program* program);

// What becomes of them, as interleaved::Resolve says it.
struct Denoising {
  int interleave = 1;
  bool cosine_open = false;
  bool paper_cone = false;
  float edge = 0;             // twice the distance over which surfaces are kept apart
  float edges_per_depth = 0;  // as in Resolve
};
// The visibility goes to the frame's results or, of one radius of several, to `target`.
void add_denoising(const Frame& frame, const Geometry& geometry, const SumRegions& sums,
                   const Denoising& how, Program* program);
void add_denoising(const Frame& frame, const Geometry& geometry, const SumRegions& sums,
                   const Denoising& how, const VisibilityTarget& target, Program* program);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_FILTERS_INTERLEAVED_GPU_H_
