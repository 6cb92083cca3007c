#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_H_

#include <memory>

#include "obscura/point.h"
#include "screen/method.h"
#include "screen/volumetric/point/screen_pattern_kernel.h"

namespace obscura {

// Blocks of so many pixels see all turns of the pattern (core/reflection_noise.h).
inline constexpr int kScreenPatternInterleave = 4;

// On the CPU: point samples on the screen (PointPattern::kScreen) of one sphere, with their
// own blur if settings.blur: neighbours whose patterns differ are put together as in
// filters/interleaved. `width` x `height` is the whole depth image.
//
// Directions: the surface point of each sample that occludes tells the direction that is lost, so
// that mean V w = n/2 - sum of the occluding samples' weights times the directions to their points.
std::unique_ptr<Method> make_screen_point(const PointSettings& settings,
                                          const ScreenPatternFrame& frame, int width, int height);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_H_
