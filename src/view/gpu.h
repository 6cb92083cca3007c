#ifndef OBSCURA_SRC_VIEW_GPU_H_
#define OBSCURA_SRC_VIEW_GPU_H_

#include "gpu/frame.h"
#include "gpu/program.h"

// The passes that turn images of depth into geometry (view/geometry.h).
namespace obscura::gpu {

// Adds linear depth and, if asked for, normals; or gives what the frame has.
Geometry add_geometry(const Frame& frame, bool normals, Program* program);

// Adds where matter ends, linear depth: the back depth given (FrameShape::back_depth) or, where
// there is none, matter as thick as `geometry` is wide (view/widths.h); or gives what the frame
// has.
int add_back_depth(const Frame& frame, const Geometry& geometry, Program* program);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_VIEW_GPU_H_
