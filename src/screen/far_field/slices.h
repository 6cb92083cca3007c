#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SLICES_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SLICES_H_

#include <cstddef>

#include "math/falloff.h"
#include "math/slice_sums.h"
#include "screen/far_field/directions.h"
#include "screen/far_field/plane.h"
#include "screen/far_field/scan.h"

namespace obscura::far_field {

// One direct sample as the receivers of one phase meet it: where its four texels lie from
// SliceRow::texels for receiver 0; those of receiver i are i further on.
struct TapRead {
  std::ptrdiff_t upper, upper_next, lower, lower_next;
  float wu, wv;  // weights of the next and of the lower texels
  float along;   // rows outwards
};

// One interval likewise: receiver i averages the lines from entry first + i of `from` to entry
// last + i of `to`. The numbers are the same for all receivers of a row's phase.
struct IntervalRead {
  PrefixSums from, to;
  int first, last;
  float inverse_lines;

  // Finite occluders average nothing: line middle + i.
  RawStrip line;
  int middle;
  float away;  // rows to the strip's middle
};

// One segment of one direction for the receivers of one phase of a row.
struct SliceRow {
  const Plane* plane;
  const math::Rho* rho;
  SliceSums sums;
  bool chord;
  int sign;
  int row, column;   // of the visible part; `column` is the first receiver's
  int begin, count;  // receivers from `begin`, a multiple of 16, up to `count`
  const Segment* segment;
  const float* texels;  // of Plane::lattice, in the receivers' row
  const float* backs;   // finite occluders: the same of Plane::back
  const TapRead* taps;
  int tap_count;
  const IntervalRead* intervals;
  int interval_count;

  // Finite occluders.
  float slope;   // of the scan's second height: +1 or -1
  float slack;   // relative gap in depth that joins neighbours
  float dither;  // [-0.5, 0.5)

  // Receivers' rows that w_k times the slice's integrals are added to: obscurance (equation 2; may
  // be null), then directions along the plane's u and v axes and along the view ray, and the
  // obscured solid angle.
  float* out[5];
};

void add_slices(const SliceRow& job);

// The same where matter has an end (Plane::finite).
void add_matter_slices(const SliceRow& job);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SLICES_H_
