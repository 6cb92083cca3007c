#include "screen/far_field/lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura::far_field {

LineLayout::LineLayout(int width, int height, const Direction& direction, int line_step)
    : slope(direction.slope), step(line_step) {
  // Anchored at the middle row, so that mirrored images have mirrored lines.
  const double reach = std::abs(slope) * (height - 1);
  first = -0.5 * slope * (height - 1) - std::ceil(0.5 * reach) - 1;
  const int all = width + 2 * static_cast<int>(std::ceil(0.5 * reach)) + 3;
  lines = (all + step - 1) / step;
}

StripLevels::StripLevels(int height, int strip_offset, int interval) {
  int strips = (height + strip_offset + interval - 1) / interval;
  for (;; strips = (strips + 1) / 2) {
    start.push_back(start.back() + strips);
    if (strips <= 2) break;
  }
}

namespace {

int first_strip(const Direction& direction, int interval, int row) {
  return (row + direction.strip_offset + 2 * interval - 1) / interval;
}

}  // namespace

int find_intervals(const Direction& direction, const Segment& segment, const LineLayout& layout,
                   const StripLevels& levels, const Climb& climb, int row, int u,
                   IntervalLines* found) {
  const int interval = climb.interval;
  int count = 0, level = 0, strip = first_strip(direction, interval, row);
  while (strip < levels.strips(level) && count < kMaxIntervals) {
    const double size = static_cast<double>(interval) * (1 << level);
    const double away = (strip + 0.5) * size - 0.5 - direction.strip_offset - row;
    const double start = u - layout.shift(row + away);
    auto line_at = [&](double slope) { return (slope * away + start) / layout.step; };
    const int middle = static_cast<int>(std::floor(line_at(segment.middle) + 0.5));
    int first = static_cast<int>(std::ceil(line_at(segment.low)));
    int last = static_cast<int>(std::floor(line_at(segment.high)));
    if (first > last) first = last = middle;
    found[count++] = {level, strip, first, last, middle, away};
    ++strip;
    const double distance = strip * size - direction.strip_offset - row;
    if (strip % 2 == 0 && level + 1 < levels.levels() && distance >= climb.lengths * 2 * size) {
      strip /= 2;
      ++level;
    }
  }
  return count;
}

int near_rows(const Direction& direction, int interval, int row, int height) {
  const int end = first_strip(direction, interval, row) * interval - direction.strip_offset;
  return std::min(end, height) - row;
}

int count_taps(const Segment& segment, int row, int rows, int height) {
  int count = 0;
  for (const NearTap& tap : segment.taps) {
    if (tap.along >= rows || row + tap.dv + (tap.wv > 0 ? 1 : 0) >= height) break;
    ++count;
  }
  return count;
}

int phases_of(const FarFieldSettings& s) { return std::lcm(group_side(s), s.line_step); }

int cell_of(const Direction& direction, int side, int row, int phase) {
  const int u = phase % side, v = row % side;
  return direction.transposed ? side * u + v : side * v + u;
}

float dither(const Direction& direction, const Segment& segment) {
  const double x = 5.3 * std::abs(segment.middle) + 0.37 * direction.transposed;
  return static_cast<float>(x - std::floor(x) - 0.5);
}

}  // namespace obscura::far_field
