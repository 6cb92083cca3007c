#ifndef OBSCURA_SRC_FILTERS_INTERLEAVED_GPU_H_
#define OBSCURA_SRC_FILTERS_INTERLEAVED_GPU_H_

#include "gpu/volumetric.h"

namespace obscura::vulkan {

// Sums of an interleaved pattern, per visible pixel; -1: none.
struct SumRegions {
  int open = -1;        // float: the visibility where `directions` has another open share, or none
  int directions = -1;  // vec4: the difference to the normal's share, and the open share
};
SumRegions add_sums(const FrameShape& shape, bool open, bool directions, Program* program);

// What becomes of them, as directional::Resolve says it.
struct Resolution {
  int interleave = 1;
  bool cosine_open = false;
  bool paper_cone = false;
  float edge = 0;          // twice the distance over which surfaces are kept apart
  float longest_edge = 0;  // as a share of the farthest depth; 0: not bounded
  const VisibilityTarget* target = nullptr;  // null: the frame's visibility
};
void add_resolution(const FrameShape& shape, const Geometry& geometry, const SumRegions& sums,
                    const Resolution& how, Program* program);

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_FILTERS_INTERLEAVED_GPU_H_
