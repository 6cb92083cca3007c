#ifndef OBSCURA_SRC_SCREEN_HALF_RESOLUTION_GPU_H_
#define OBSCURA_SRC_SCREEN_HALF_RESOLUTION_GPU_H_

#include <functional>

#include "gpu/program.h"
#include "view/half.h"

namespace obscura::vulkan {

// What a method sees at half resolution (screen/half_resolution.h).
inline view::HalfAxis half_columns(const FrameShape& s) {
  return view::halve(s.width, s.guard_band.left, visible_width(s));
}
inline view::HalfAxis half_rows(const FrameShape& s) {
  return view::halve(s.height, s.guard_band.top, visible_height(s));
}
FrameShape half_shape(const FrameShape& shape);

// The passes of a method at half resolution, which `make` adds for a shape, and what goes around
// them.
using MakeProgram = std::function<Status(const FrameShape& shape, Program* program)>;
Status make_half_program(const FrameShape& shape, const MakeProgram& make, Program* program);

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_SCREEN_HALF_RESOLUTION_GPU_H_
