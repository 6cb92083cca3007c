#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SLICES_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SLICES_H_

#include "math/falloff.h"
#include "screen/far_field/directions.h"
#include "screen/far_field/plane.h"
#include "screen/far_field/scan.h"

namespace obscura::far_field {

// One interval as a segment of a row of receivers meets it: the receiver at u averages the lines
// [u + first, u + last) of `sums`. The numbers are the same for all receivers of a row.
struct IntervalRead {
  PrefixSums sums;
  int first, last;
  float inverse_lines;  // 1 / (last - first)

  // Finite occluders average nothing: the line at u + middle.
  const float *nearest, *slanted, *deepest;
  int middle;
};

// One segment of one direction for a row of receivers.
struct SliceRow {
  const Plane* plane;
  const math::Rho* rho;
  bool chord;
  bool partial;  // some interval may be covered in part only
  int sign;
  int row;  // of the visible part
  const Segment* segment;
  int lines;
  int tap_count;  // of segment->taps
  const IntervalRead* intervals;
  int interval_count;

  // Finite occluders.
  float slope;   // of the scan's second height: +1 or -1
  float slack;   // relative gap in depth that joins neighbours
  float dither;  // [-0.5, 0.5)
};

// Adds w_k times the slice's integral (equation 2) to the row of plane->obscurance.
void add_slices(const SliceRow& job, float* obscurance);

// The same where matter has an end (Plane::finite).
void add_matter_slices(const SliceRow& job, float* obscurance);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SLICES_H_
