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

void ScanBuffer::resize(const Plane& plane, const Direction& direction, int interval,
                        int line_step) {
  const LineLayout layout(plane.width, plane.height, direction, line_step);
  phases_.count = plane.lattice.phases() / line_step;
  phase_lines_ = (layout.lines + phases_.count - 1) / phases_.count;
  phases_.stride = round_up(phase_lines_ + 1) + 3 * PrefixSums::kPadding;
  pyramid_ = StripLevels(plane.height, direction.strip_offset, interval);
  const int width = static_cast<int>(phases_.stride) * phases_.count, rows = pyramid_.all();
  nearest_.resize(width, rows);
  slanted_.resize(width, rows);
  if (plane.finite) {
    deepest_.resize(width, rows);
    for (auto* image : {&begin_, &end_, &rest_front_, &rest_back_, &rest_filled_})
      image->resize(width, rows);
  } else {
    depth_.resize(width, rows);
    outward_.resize(width, rows);
    count_.resize(width, rows);
  }
}

PrefixSums ScanBuffer::sums(int level, int strip, int phase) {
  const int i = pyramid_.index(level, strip);
  const std::ptrdiff_t at = phase * phases_.stride + PrefixSums::kPadding;
  return {depth_.row(i) + at, outward_.row(i) + at, count_.row(i) + at};
}
RawStrip ScanBuffer::raw(int level, int strip, int phase) {
  const int i = pyramid_.index(level, strip);
  const std::ptrdiff_t at = phase * phases_.stride + PrefixSums::kPadding;
  auto row = [&](AlignedImage<float>& image) {
    return image.empty() ? nullptr : image.row(i) + at;
  };
  return {row(nearest_), row(slanted_),    row(deepest_),   row(begin_),
          row(end_),     row(rest_front_), row(rest_back_), row(rest_filled_)};
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
  const int padded = round_up(buffer->phase_lines());
  int begin = padded, end = 0;
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
  end = std::clamp(round_up(end), begin, padded);
  const RawStrip out = buffer->raw(0, strip, phase);
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr int kPad = PrefixSums::kPadding;
  auto clear = [&](float* row, float value) {
    std::fill(row - kPad, row + begin, value);
    std::fill(row + end, row + padded + kPad, value);
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
                     .ortho_offset = plane.ortho_offset,
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
      const int lines = round_up(buffer->phase_lines()) + 2 * PrefixSums::kPadding;
      auto raw = [&](int l, int i, int phase) {
        RawStrip r = buffer->raw(l, i, phase);
        for (float** row : {&r.nearest, &r.slanted, &r.deepest, &r.begin, &r.end, &r.rest_front,
                            &r.rest_back, &r.rest_filled}) {
          if (*row) *row -= PrefixSums::kPadding;
        }
        return r;
      };
      for (int phase = 0; phase < buffer->phases(); ++phase) {
        const RawStrip out = raw(level, strip, phase);
        const RawStrip first = raw(level - 1, a, phase), second = raw(level - 1, b, phase);
        plane.finite
            ? merge_matter(lines, slack, plane.scale_v, first, b > a ? &second : nullptr, out)
            : merge_strips(lines, first, second, out);
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
    sum_lines(layout.lines, buffer->phases(), buffer->phase_stride(), slope,
              buffer->raw(level, strip, 0), buffer->sums(level, strip, 0));
  });
}

}  // namespace obscura::far_field
