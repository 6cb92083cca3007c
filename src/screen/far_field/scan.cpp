#include "screen/far_field/scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "screen/far_field/scan_kernel.h"

namespace obscura::far_field {
namespace {

constexpr int kVector = 16;  // lines are processed in multiples of the widest vector
constexpr int kMaxInterval = 64;

int round_up(int n) { return (n + kVector - 1) / kVector * kVector; }

}  // namespace

LineLayout::LineLayout(const Plane& plane, const Direction& direction) : slope(direction.slope) {
  // Anchored at the middle row, so that mirrored images have mirrored lines.
  const double reach = std::abs(slope) * (plane.height - 1);
  first = -0.5 * slope * (plane.height - 1) - std::ceil(0.5 * reach) - 1;
  lines = plane.width + 2 * static_cast<int>(std::ceil(0.5 * reach)) + 3;
}

void ScanBuffer::resize(const Plane& plane, const Direction& direction, int interval) {
  lines_ = LineLayout(plane, direction).lines;
  level_start_.assign(1, 0);
  int strips = (plane.height + direction.phase + interval - 1) / interval;
  for (;; strips = (strips + 1) / 2) {
    level_start_.push_back(level_start_.back() + strips);
    if (strips <= 2) break;
  }
  const int width = round_up(lines_ + 1) + 3 * PrefixSums::kPadding, rows = level_start_.back();
  nearest_.resize(width, rows);
  slanted_.resize(width, rows);
  if (plane.finite) {
    deepest_.resize(width, rows);
  } else {
    depth_.resize(width, rows);
    outward_.resize(width, rows);
    count_.resize(width, rows);
  }
}

PrefixSums ScanBuffer::sums(int level, int strip) {
  const int i = index(level, strip), pad = PrefixSums::kPadding;
  return {depth_.row(i) + pad, outward_.row(i) + pad, count_.row(i) + pad};
}
float* ScanBuffer::nearest(int level, int strip) {
  return nearest_.row(index(level, strip)) + PrefixSums::kPadding;
}
float* ScanBuffer::slanted(int level, int strip) {
  return slanted_.row(index(level, strip)) + PrefixSums::kPadding;
}
float* ScanBuffer::deepest(int level, int strip) {
  return deepest_.row(index(level, strip)) + PrefixSums::kPadding;
}

std::size_t ScanBuffer::bytes() const {
  const std::size_t doubles = depth_.stride() * depth_.height() * 2;
  const std::size_t floats = count_.stride() * count_.height() +
                             2 * nearest_.stride() * nearest_.height() +
                             deepest_.stride() * deepest_.height();
  return doubles * sizeof(double) + floats * sizeof(float);
}

void scan(const Plane& plane, const Direction& direction, int interval, int receiver_slope,
          Executor& executor, ScanBuffer* buffer) {
  buffer->resize(plane, direction, interval);
  const LineLayout layout(plane, direction);
  const float slope = receiver_slope < 0 ? 1.0f : -1.0f;
  const int padded = round_up(layout.lines);
  const float slack = join_slack(plane);
  executor.parallel_for(buffer->strips(0), [&](int strip, int) {
    ScanRow rows[kMaxInterval];
    const int start = strip * interval - direction.phase, first = std::max(start, 0);
    const int count = std::max(0, std::min(start + interval, plane.height) - first);
    int begin = padded, end = 0;
    for (int i = 0; i < count; ++i) {
      const int r = first + i, v = direction.sign > 0 ? r : plane.height - 1 - r;
      const double shift = layout.shift(r), whole = std::floor(shift);
      const int offset = static_cast<int>(whole);
      rows[i] = {plane.lattice.row(v), plane.finite ? plane.back.row(v) : nullptr, offset,
                 static_cast<float>(shift - whole),
                 direction.sign * (v - plane.center_v) * plane.scale_v};
      begin = std::min(begin, -offset - 1);
      end = std::max(end, plane.width - offset);
    }
    begin = std::max(begin, 0) / kVector * kVector;
    end = std::clamp(round_up(end), begin, padded);
    float* nearest = buffer->nearest(0, strip);
    float* slanted = buffer->slanted(0, strip);
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr int kPad = PrefixSums::kPadding;
    auto clear = [&](float* row, float value) {
      std::fill(row - kPad, row + begin, value);
      std::fill(row + end, row + padded + kPad, value);
    };
    clear(nearest, kInf);
    clear(slanted, -kInf);
    float* deepest = plane.finite ? buffer->deepest(0, strip) : nullptr;
    if (deepest) clear(deepest, 0);
    const StripJob job{rows,  count,   begin,   end,    plane.orthographic, plane.kappa, slope,
                       slack, nearest, slanted, deepest};
    if (plane.finite) return scan_matter(job);
    scan_strip(job);
    sum_lines(layout.lines, slope, nearest, slanted, buffer->sums(0, strip));
  });
  for (int level = 1; level < buffer->levels(); ++level) {
    executor.parallel_for(buffer->strips(level), [&](int strip, int) {
      const int a = 2 * strip, b = std::min(a + 1, buffer->strips(level - 1) - 1);
      float* nearest = buffer->nearest(level, strip);
      float* slanted = buffer->slanted(level, strip);
      if (plane.finite) {
        constexpr int kPad = PrefixSums::kPadding;
        auto raw = [&](int l, int i) {
          return RawStrip{buffer->nearest(l, i) - kPad, buffer->slanted(l, i) - kPad,
                          buffer->deepest(l, i) - kPad};
        };
        merge_matter(padded + 2 * kPad, slack, raw(level - 1, a), raw(level - 1, b),
                     raw(level, strip));
        return;
      }
      merge_strips(padded, buffer->nearest(level - 1, a), buffer->slanted(level - 1, a),
                   buffer->nearest(level - 1, b), buffer->slanted(level - 1, b), nearest, slanted);
      sum_lines(layout.lines, slope, nearest, slanted, buffer->sums(level, strip));
    });
  }
}

}  // namespace obscura::far_field
