#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_

#include "screen/far_field/scan.h"

namespace obscura::far_field {

// One row of a strip: line j reads texels j + offset and the next, blended by `blend`.
struct ScanRow {
  const float* lattice;  // texel 0 of the row
  const float* back;     // finite occluders: the same of Plane::back
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
  float slack;  // finite occluders: relative gap in depth that joins neighbours
  float* nearest;
  float* slanted;
  float* deepest;
};
void scan_strip(const StripJob& job);

// The same for finite occluders: of each line's connected pieces of matter, the nearest.
void scan_matter(const StripJob& job);

// Maxima of two strips of the level below.
void merge_strips(int lines, const float* near_a, const float* slant_a, const float* near_b,
                  const float* slant_b, float* nearest, float* slanted);

struct RawStrip {
  float* nearest;
  float* slanted;
  float* deepest;
};
void merge_matter(int lines, float slack, const RawStrip& a, const RawStrip& b,
                  const RawStrip& out);

void sum_lines(int lines, float slope, const float* nearest, const float* slanted,
               const PrefixSums& sums);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_
