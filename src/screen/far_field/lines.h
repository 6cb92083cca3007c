#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_LINES_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_LINES_H_

#include <vector>

#include "screen/far_field/directions.h"

// Where scanned lines lie and what the receivers of a row read of them. Nothing here knows the
// camera or the depth, so that the CPU finds it row by row and Vulkan takes it as a table.
namespace obscura::far_field {

inline constexpr int kMaxIntervals = 64;

// Scanned line j crosses row r (counted outwards) at u = j * step + shift(r).
struct LineLayout {
  LineLayout(int width, int height, const Direction& direction, int step);
  double shift(double row) const { return first + slope * row; }

  double slope, first;
  int step, lines;
};

// The pyramid of a direction's strips: level l has strips of interval * 2^l rows, counted from the
// edge at which scanned lines begin.
struct StripLevels {
  StripLevels() = default;
  StripLevels(int height, int strip_offset, int interval);

  int levels() const { return static_cast<int>(start.size()) - 1; }
  int strips(int level) const { return start[level + 1] - start[level]; }
  int all() const { return start.back(); }
  int index(int level, int strip) const { return start[level] + strip; }

  std::vector<int> start{0};  // of each level among all strips
};

// One interval as a receiver reads it: the lines of one strip from `first` to `last`, or the one
// nearest to the segment's middle.
struct IntervalLines {
  int level, strip;
  int first, last, middle;
  double away;  // rows from the receiver to the strip's middle
};

// How intervals grow: from `interval` rows on, every second one doubles, but only from where it is
// `lengths` of its new lengths away on. The paper's profile takes them as published; with matter
// that ends more of them gain nothing.
struct Climb {
  explicit Climb(const FarFieldSettings& s)
      : interval(s.interval),
        lengths(s.occluder.kind == OccluderKind::kSolid && s.profile != SlabProfile::kSlab ? 2
                                                                                           : 0) {}
  int interval, lengths;
};

// Which intervals a segment reads for the receiver at texel u of a row (`row` counted outwards):
// the nearest is at least one interval away; every second one may climb a level of the pyramid
// (Timonen 2013, section 6). Returns how many, at most kMaxIntervals.
int find_intervals(const Direction& direction, const Segment& segment, const LineLayout& layout,
                   const StripLevels& levels, const Climb& climb, int row, int u,
                   IntervalLines* found);

// Rows outwards of a row to its first interval or to the image's edge.
int near_rows(const Direction& direction, int interval, int row, int height);

// How many samples lie within `rows` rows outwards of a row (counted outwards) and in the image.
int count_taps(const Segment& segment, int row, int rows, int height);

// Pixels that do alike lie this far apart along a row.
int phases_of(const FarFieldSettings& settings);

// Of a pixel in column `phase` of a row's phases, in groups of `side`. Cells are the image's,
// whichever way the plane lies.
int cell_of(const Direction& direction, int side, int row, int phase);

// What moves the rounding to sectors; the same for a slice and its mirror image.
float dither(const Direction& direction, const Segment& segment);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_LINES_H_
