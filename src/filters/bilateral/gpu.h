#ifndef OBSCURA_SRC_FILTERS_BILATERAL_GPU_H_
#define OBSCURA_SRC_FILTERS_BILATERAL_GPU_H_

#include "gpu/frame.h"
#include "gpu/program.h"

namespace obscura::gpu {

// Adds the edge-aware blur (filters/bilateral/bilateral.h) from a region of visibility to the
// frame's result. `edge` in world units.
void add_blur(const Frame& frame, const Geometry& geometry, int visibility, float edge,
              Program* program);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_FILTERS_BILATERAL_GPU_H_
