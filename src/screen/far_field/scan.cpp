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

// Lines of any phase that meet rows [first, last) of the image, a texel around it included.
LineWindow window_of(const Plane& plane, const LineLayout& layout, int phase_lines, int first,
                     int last) {
  const int step = plane.lattice.phases();
  const double a = layout.shift(first), b = layout.shift(last - 1);
  // Line i of a phase lies at texel + i * step; of the farthest right and left texel.
  const int right = step + static_cast<int>(std::floor(std::max(a, b)));
  const int left = static_cast<int>(std::floor(std::min(a, b)));
  const int low = std::max(0, (-1 - right) / step);
  const int high = (plane.width - left + step - 1) / step;
  const int begin = low / kVector * kVector;
  return {begin, std::clamp(round_up(high), begin, std::max(begin, round_up(phase_lines)))};
}

}  // namespace

void ScanBuffer::resize(const Plane& plane, const Direction& direction, int interval,
                        int line_step) {
  const LineLayout layout(plane.width, plane.height, direction, line_step);
  phases_ = plane.lattice.phases() / line_step;
  phase_lines_ = (layout.lines + phases_ - 1) / phases_;
  pyramid_ = StripLevels(plane.height, direction.strip_offset, interval);
  strips_.clear();
  int rows = 0;
  for (int level = 0; level < levels(); ++level) {
    const int size = interval << level;
    for (int strip = 0; strip < strips(level); ++strip) {
      const int start = strip * size - direction.strip_offset;
      const LineWindow window = window_of(plane, layout, phase_lines_, std::max(start, 0),
                                          std::min(start + size, plane.height));
      strips_.push_back({window, rows});
      rows += stride(window) / kVector * phases_;
    }
  }
  nearest_.resize(kVector, rows);
  slanted_.resize(kVector, rows);
  if (plane.finite) {
    deepest_.resize(kVector, rows);
    for (auto* image : {&begin_, &end_, &rest_front_, &rest_back_, &rest_filled_})
      image->resize(kVector, rows);
  } else {
    depth_.resize(kVector, rows);
    outward_.resize(kVector, rows);
    count_.resize(kVector, rows);
  }
}

std::ptrdiff_t ScanBuffer::origin(const Strip& s, int phase) const {
  return std::ptrdiff_t{phase} * stride(s.window) + PrefixSums::kPadding - s.window.begin;
}
PrefixSums ScanBuffer::sums(int level, int strip, int phase) {
  const Strip& s = strips_[static_cast<std::size_t>(pyramid_.index(level, strip))];
  const std::ptrdiff_t at = origin(s, phase);
  return {depth_.row(s.row) + at, outward_.row(s.row) + at, count_.row(s.row) + at, s.window};
}
RawStrip ScanBuffer::raw(int level, int strip, int phase) {
  const Strip& s = strips_[static_cast<std::size_t>(pyramid_.index(level, strip))];
  const std::ptrdiff_t at = origin(s, phase);
  auto row = [&](AlignedImage<float>& image) {
    return image.empty() ? nullptr : image.row(s.row) + at;
  };
  return {row(nearest_),    row(slanted_),   row(deepest_),     row(begin_), row(end_),
          row(rest_front_), row(rest_back_), row(rest_filled_), s.window};
}

std::size_t ScanBuffer::bytes() const {
  const std::size_t doubles = depth_.stride() * depth_.height() * 2;
  const std::size_t floats = count_.stride() * count_.height() +
                             2 * nearest_.stride() * nearest_.height() +
                             6 * deepest_.stride() * deepest_.height();
  return doubles * sizeof(double) + floats * sizeof(float);
}

namespace {

// Scans one strip of rows along the lines of one phase.
void scan_phase(const Plane& plane, const Direction& direction, const LineLayout& layout,
                const ScanSettings& settings, int strip, int phase, ScanBuffer* buffer) {
  const int interval = settings.interval;
  ScanRow rows[kMaxInterval];
  const int start = strip * interval - direction.strip_offset, first = std::max(start, 0);
  const int count = std::max(0, std::min(start + interval, plane.height) - first);
  const LineWindow window = buffer->window(0, strip);
  int begin = window.end, end = 0;
  for (int i = 0; i < count; ++i) {
    const int r = first + i, v = direction.sign > 0 ? r : plane.height - 1 - r;
    const double shift = layout.shift(r), whole = std::floor(shift);
    const int offset = static_cast<int>(whole);
    // Only lines that meet the row are scanned; for the others, in the same vectors, the place of
    // the first may lie outside the image, margin and all.
    const int texel = phase * settings.line_step + offset;
    const int texel_step = plane.lattice.phases();
    const int low = std::max(0, (-1 - texel) / texel_step);
    const int high = (plane.width - texel + texel_step - 1) / texel_step;
    const int aligned = low / kVector * kVector;
    auto at = [&](const PhaseImage& image, int u) {
      return image.at(v, u + aligned * texel_step) - aligned;
    };
    rows[i] = {at(plane.lattice, texel),
               at(plane.lattice, texel + 1),
               plane.finite ? at(plane.back, texel) : nullptr,
               plane.finite ? at(plane.back, texel + 1) : nullptr,
               static_cast<float>(shift - whole),
               direction.sign * (v - plane.center_v) * plane.scale_v};
    begin = std::min(begin, aligned);
    end = std::max(end, high);
  }
  end = std::clamp(round_up(end), begin, window.end);
  const RawStrip out = buffer->raw(0, strip, phase);
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr int kPad = PrefixSums::kPadding;
  auto clear = [&](float* row, float value) {
    std::fill(row + window.begin - kPad, row + begin, value);
    std::fill(row + end, row + window.end + kPad, value);
  };
  clear(out.nearest, kInf);
  clear(out.slanted, -kInf);
  if (plane.finite) {
    clear(out.deepest, 0);
    clear(out.begin, 0);
    clear(out.end, 0);
    clear(out.rest_front, kInf);
    clear(out.rest_back, 0);
    clear(out.rest_filled, 0);
  }
  const StripJob job{.rows = rows,
                     .row_count = count,
                     .begin = begin,
                     .end = end,
                     .orthographic = plane.orthographic,
                     .slope = settings.receiver_slope < 0 ? 1.0f : -1.0f,
                     .slack = join_slack(plane),
                     .out = out};
  plane.finite ? scan_matter(job) : scan_strip(job);
}

}  // namespace

void scan(const Plane& plane, const Direction& direction, const ScanSettings& settings,
          Executor& executor, ScanBuffer* buffer) {
  buffer->resize(plane, direction, settings.interval, settings.line_step);
  const LineLayout layout(plane.width, plane.height, direction, settings.line_step);
  const float slack = join_slack(plane);
  executor.parallel_for(buffer->strips(0), [&](int strip, int) {
    for (int phase = 0; phase < buffer->phases(); ++phase) {
      scan_phase(plane, direction, layout, settings, strip, phase, buffer);
    }
  });
  for (int level = 1; level < buffer->levels(); ++level) {
    executor.parallel_for(buffer->strips(level), [&](int strip, int) {
      const int a = 2 * strip, b = std::min(a + 1, buffer->strips(level - 1) - 1);
      for (int phase = 0; phase < buffer->phases(); ++phase) {
        const RawStrip out = buffer->raw(level, strip, phase);
        const RawStrip first = buffer->raw(level - 1, a, phase);
        const RawStrip second = buffer->raw(level - 1, b, phase);
        plane.finite ? merge_matter(slack, plane.scale_v, first, b > a ? &second : nullptr, out)
                     : merge_strips(first, second, out);
      }
    });
  }
}

void sum(const Plane& plane, const Direction& direction, const ScanSettings& settings,
         Executor& executor, ScanBuffer* buffer) {
  if (plane.finite) return;
  const LineLayout layout(plane.width, plane.height, direction, settings.line_step);
  const float slope = settings.receiver_slope < 0 ? 1.0f : -1.0f;
  executor.parallel_for(buffer->all_strips(), [&](int index, int) {
    int level = 0, strip = index;
    while (strip >= buffer->strips(level)) strip -= buffer->strips(level++);
    sum_lines(layout.lines, buffer->phases(), buffer->phase_stride(level, strip), slope,
              buffer->raw(level, strip, 0), buffer->sums(level, strip, 0));
  });
}

}  // namespace obscura::far_field
