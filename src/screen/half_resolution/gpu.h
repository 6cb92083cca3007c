#ifndef OBSCURA_SRC_SCREEN_HALF_RESOLUTION_GPU_H_
#define OBSCURA_SRC_SCREEN_HALF_RESOLUTION_GPU_H_

#include <functional>

#include "gpu/frame.h"
#include "gpu/program.h"

namespace obscura::gpu {

// What a pass at half resolution (screen/half_resolution/half_resolution.h) sees of a frame.
FrameConstants half_frame_constants(const FrameShape& shape, const FrameView& view);

// Adds a method at half resolution and what goes around it. `make` adds the method's passes for a
// frame of half the size, whose geometry is there and whose results are regions; with `back`, where
// matter ends is part of that geometry.
Status make_half_program(const Frame& frame, bool back,
                         const std::function<Status(const Frame& half)>& make, Program* program);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_SCREEN_HALF_RESOLUTION_GPU_H_
