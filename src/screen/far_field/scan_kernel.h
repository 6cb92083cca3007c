#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_

#include "screen/far_field/scan.h"

namespace obscura::far_field {

// One row of a strip: line j reads texels j + offset and the next, blended by `blend`.
struct ScanRow {
  const float* lattice;  // texel 0 of the row
  int offset;
  float blend;
  float outward;  // outward coordinate of the row at depth 1, or in world units
};

// Maxima of a strip's rows for lines [begin, end), begin and end multiples of a vector.
struct StripJob {
  const ScanRow* rows;
  int row_count;
  int begin, end;
  bool orthographic;
  float kappa;
  float slope;  // +1: m1 = max(x - depth), for a receiver that looks down; -1: the other way
  float* nearest;
  float* slanted;
};
void scan_strip(const StripJob& job);

// Maxima of two strips of the level below.
void merge_strips(int lines, const float* near_a, const float* slant_a, const float* near_b,
                  const float* slant_b, float* nearest, float* slanted);

void sum_lines(int lines, float slope, const float* nearest, const float* slanted,
               const PrefixSums& sums);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_
