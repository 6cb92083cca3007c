#ifndef OBSCURA_SRC_SCREEN_GPU_H_
#define OBSCURA_SRC_SCREEN_GPU_H_

#include "gpu/frame.h"
#include "gpu/program.h"
#include "obscura/estimator.h"

namespace obscura::gpu {

// Adds the passes of a method; settings or a frame that it cannot work with are refused with a
// message. The gpu.cpp of each method that runs on a GPU (MethodInfo) holds the specialisation for
// its settings.
template <class Settings>
Status make_program(const Settings& settings, const Frame& frame, Program* program);

// Of any method, at the resolution that its settings ask for.
Status make_program(const MethodSettings& settings, const FrameShape& shape, Program* program);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_SCREEN_GPU_H_
