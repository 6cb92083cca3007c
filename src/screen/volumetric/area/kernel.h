#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_KERNEL_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_KERNEL_H_

#include "screen/volumetric/area/moments.h"
#include "view/tap_frame.h"

namespace obscura {

inline constexpr int kMaxAreaSamples = 16;

// Entries of the tables by level: as many as fill a vector.
inline constexpr int kLevelTable = 16;

// One frame of area sampling as the kernel sees it.
struct AreaFrame {
  view::TapFrame view;
  float thickness = 0;  // 0: solid
  bool quadratic = false;

  const MomentPyramid::Texel* texels = nullptr;
  int levels = 0;
  int columns = 0;  // of level 0, from which each level's stride follows
  // Per level: where its texels start, and its kernel's deviation in pixels.
  std::int32_t start[kLevelTable] = {};
  float width[kLevelTable + 1] = {};

  // The pattern on the unit disk, y down; lengths in radii.
  int samples = 0;
  float x[kMaxAreaSamples] = {}, y[kMaxAreaSamples] = {};
  float lateral[kMaxAreaSamples] = {};  // sqrt(x^2 + y^2)
  float extent[kMaxAreaSamples] = {};   // zs = sqrt(1 - x^2 - y^2)
  float half[kMaxAreaSamples] = {};     // integral of rho from 0 to zs
  float weight[kMaxAreaSamples] = {};   // w_i / sum w / (2 half_i)
  // Added to log2 of the radius in pixels: the level whose kernel is as wide as the sample's cell.
  float level[kMaxAreaSamples] = {};
};

// Writes the visibility of the visible pixels [begin, end) of visible row `row` to out[0...].
// Background pixels get 1. `begin` is a multiple of 64.
void area_row(const AreaFrame& frame, int row, int begin, int end, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_KERNEL_H_
