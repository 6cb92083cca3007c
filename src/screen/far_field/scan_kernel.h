#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_

#include "screen/far_field/scan.h"

namespace obscura::far_field {

// One row of a strip: line j of a phase lies between lattice[j] and next[j], at `blend` of the way.
struct ScanRow {
  const float *lattice, *next;
  const float *back, *next_back;  // finite occluders: the same of Plane::back
  float blend;
  float outward;  // outward coordinate of the row at depth 1, or in world units
};

// Maxima of a strip's rows for a phase's lines [begin, end), multiples of a vector.
struct StripJob {
  const ScanRow* rows;
  int row_count;
  int begin, end;
  bool orthographic;
  float slope;  // +1: m1 = max(x - depth), for a receiver that looks down; -1: the other way
  float slack;  // finite occluders: relative gap in depth that joins neighbours
  RawStrip out;
};
void scan_strip(const StripJob& job);

// The same for finite occluders: of each line's connected pieces of matter, the nearest.
void scan_matter(const StripJob& job);

// Maxima of two strips of the level below, for the lines of `out`'s window and its padding; of
// matter `b` may be null, where there is no second.
void merge_strips(const RawStrip& a, const RawStrip& b, const RawStrip& out);
void merge_matter(float slack, float row, const RawStrip& a, const RawStrip* b,
                  const RawStrip& out);

// Running sums over all lines of the window in their order, phase after phase; `strip` and `sums`
// are those of phase 0, the next lies `phase_stride` farther.
void sum_lines(int lines, int phases, std::ptrdiff_t phase_stride, float slope,
               const RawStrip& strip, const PrefixSums& sums);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SCAN_KERNEL_H_
