#ifndef OBSCURA_SRC_SCREEN_GPU_H_
#define OBSCURA_SRC_SCREEN_GPU_H_

#include "gpu/frame.h"
#include "gpu/program.h"
#include "obscura/estimator.h"

namespace obscura::gpu {

// Adds the passes of a method, in its gpu.cpp; settings or a frame that it cannot work with are
// refused with a message.
Status make_program(const AreaSettings& settings, const Frame& frame, Program* program);
Status make_program(const FarFieldSettings& settings, const Frame& frame, Program* program);
Status make_program(const HemisphereSettings& settings, const Frame& frame, Program* program);
Status make_program(const HorizonSettings& settings, const Frame& frame, Program* program);
Status make_program(const LineSettings& settings, const Frame& frame, Program* program);
Status make_program(const MipmapSettings& settings, const Frame& frame, Program* program);
Status make_program(const PointSettings& settings, const Frame& frame, Program* program);

// Of any method, at the resolution that its settings ask for.
Status make_program(const MethodSettings& settings, const FrameShape& shape, Program* program);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_SCREEN_GPU_H_
