#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_H_

#include <memory>

#include "obscura/point.h"
#include "screen/method.h"

namespace obscura {

struct ScreenPatternFrame;

// Blocks of so many pixels see all turns of the pattern (core/reflection_noise.h).
inline constexpr int kScreenPatternInterleave = 4;

// Point samples on the screen (PointPattern::kScreen), with their own blur if settings.blur:
// neighbours whose patterns differ are put together as in filters/interleaved. `width` x
// `height` is the whole depth image. Taps are as in point.h.
//
// Directions: the surface point of each sample that occludes tells the direction that is lost, so
// that mean V w = n/2 - sum of the occluding samples' weights times the directions to their points.
Status make_screen_point(const PointSettings& settings, int width, int height,
                         std::unique_ptr<Method>* method);

// What all frames have in common: the pattern in the units that kernels want, on any device.
Status make_screen_pattern_frame(const PointSettings& settings, ScreenPatternFrame* frame);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_H_
