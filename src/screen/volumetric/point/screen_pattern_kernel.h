#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_KERNEL_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_KERNEL_H_

#include "filters/interleaved/kernel.h"
#include "obscura/patterns.h"
#include "view/tap_frame.h"

namespace obscura {

// A surface point no higher above the tangent plane than this, as an angle, lies on it: normals
// from depth are no more exact.
inline constexpr float kAngleGrain = 2e-3f;

// One frame of the screen pattern as the kernel sees it.
struct ScreenPatternFrame {
  view::TapFrame view;
  bool quadratic = false;
  // Positions in the unit disk, y up; the weights sum to 1.
  int samples = 0;
  float x[kMaxDiskSamples] = {}, y[kMaxDiskSamples] = {}, weight[kMaxDiskSamples] = {};
};

// Sums of one visible row as filters/interleaved/kernel.h has them; directions, which need
// normals, are written if out[1] is there. Whole vectors are written past the end.
void screen_pattern_row(const ScreenPatternFrame& frame, int row, int width,
                        float* const out[interleaved::kChannels]);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_KERNEL_H_
