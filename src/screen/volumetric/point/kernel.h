#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_KERNEL_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_KERNEL_H_

#include "obscura/patterns.h"
#include "view/tap_frame.h"

namespace obscura {

// One frame of point sampling as the kernels see it.
struct PointFrame {
  view::TapFrame view;
  float thickness = 0;  // 0: solid

  // Eye-space positions in the unit ball y up, z to the camera; the weights
  // sum to 1.
  int samples = 0;
  float x[kMaxBallSamples] = {}, y[kMaxBallSamples] = {}, z[kMaxBallSamples] = {};
  float weight[kMaxBallSamples] = {};
};

// Writes the visibility of the visible pixels [begin, end) of visible row `row` to out[0...].
// Background pixels get 1. `begin` is a multiple of 64.
void point_ball_row(const PointFrame& frame, int row, int begin, int end, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_KERNEL_H_
