#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_KERNEL_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_KERNEL_H_

#include "obscura/patterns.h"
#include "view/tap_frame.h"

namespace obscura {

// One frame of line sampling as the kernel sees it.
struct LineFrame {
  view::TapFrame view;
  float thickness = 0;  // 0: solid
  bool quadratic = false;
  bool tangent = false;  // the sphere in front of the tangent plane; with normals only

  // The pattern, y down, in units of the reach: the unit disk, or half of it for the tangent
  // sphere. Lengths along the lines are in world units where rho is constant, which saves a
  // multiplication per tap, and in the sphere's radii where it is quadratic.
  int samples = 0;
  float per_unit = 1;  // 1 / the lines' unit, in world units
  float x[kMaxDiskSamples] = {}, y[kMaxDiskSamples] = {};
  float lateral[kMaxDiskSamples] = {};  // distance of the line from the sphere's centre, in radii
  float extent[kMaxDiskSamples] = {};   // zs = sqrt(1 - x^2 - y^2), in the lines' unit
  float half[kMaxDiskSamples] = {};     // integral of rho from 0 to zs
  float weight[kMaxDiskSamples] = {};   // w_i / sum w / (2 half_i)
};

// Writes the visibility of the visible pixels [begin, end) of visible row `row` to out[0...].
// Background pixels get 1. `begin` is a multiple of 64.
void line_row(const LineFrame& frame, int row, int begin, int end, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_KERNEL_H_
