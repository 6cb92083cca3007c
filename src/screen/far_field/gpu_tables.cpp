#include "screen/far_field/gpu_tables.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "screen/far_field/far_field_scan_io.h"

namespace obscura::gpu {
namespace {

using far_field::Direction;
using far_field::IntervalLines;
using far_field::LineLayout;
using far_field::Segment;
using far_field::StripLevels;
using far_field_scan_io::kSharedLevels;

constexpr int kLeastRestart = 5;  // sums restart every 32 lines or more
// Scanned lines of one batch of directions; beyond this a batch has one direction.
constexpr std::uint64_t kBatchBytes = std::uint64_t{64} << 20;

}  // namespace

PlaneShape::PlaneShape(const FrameShape& s, bool turned, int margin)
    : transposed(turned),
      width(turned ? s.height : s.width),
      height(turned ? s.width : s.height),
      left(turned ? s.guard_band.top : s.guard_band.left),
      top(turned ? s.guard_band.left : s.guard_band.top),
      visible(turned ? Extent{s.visible().height, s.visible().width} : s.visible()),
      stride(width + 2 * margin) {}

FarFieldTables::FarFieldTables(const FarFieldPlan& plan, const FrameShape& shape)
    : settings_(plan.settings),
      directions_(plan.directions),
      phases_(plan.phases),
      margin_(plan.reach),
      planes_{{shape, false, margin_}, {shape, true, margin_}},
      rho_start_(quads_.add_floats(plan.rho.table)) {
  for (const PlaneShape& plane : planes_) make_batches(plane);
  for (Batch& batch : batches_) make_tables(&batch);
}

int FarFieldTables::raw_rows(const StripLevels& levels) const {
  return finite() ? levels.all() : levels.start[std::min(levels.levels(), kSharedLevels)];
}

void FarFieldTables::make_batches(const PlaneShape& plane) {
  Batch batch{.plane = &plane};
  auto flush = [&] {
    if (!batch.directions.empty()) batches_.push_back(batch);
    batch = {.plane = &plane};
  };
  for (const Direction& d : directions_) {
    if (d.transposed != plane.transposed) continue;
    const StripLevels levels(plane.height, d.strip_offset, settings_.interval);
    const int lines = LineLayout(plane.width, plane.height, d, settings_.line_step).lines;
    Batch larger = batch;
    larger.directions.push_back(&d);
    larger.raw_rows += raw_rows(levels);
    larger.sum_rows += sum_rows(levels);
    larger.lines = std::max(larger.lines, lines);
    larger.strips = std::max(larger.strips, levels.strips(0));
    const std::uint64_t bytes = raw_bytes(larger) + sum_bytes(larger);
    if (!batch.directions.empty() && bytes > kBatchBytes) {
      flush();
      batch.directions.push_back(&d);
      batch.raw_rows = raw_rows(levels);
      batch.sum_rows = sum_rows(levels);
      batch.lines = lines;
      batch.strips = levels.strips(0);
    } else {
      batch = larger;
    }
  }
  flush();
}

// Samples of one segment, which differ between receivers in their number only.
int FarFieldTables::add_taps(const PlaneShape& p, const Direction& d, const Segment& segment) {
  const int start = quads_.size();
  for (const far_field::NearTap& tap : segment.taps) {
    const int offset = tap.dv * d.sign * p.stride + tap.du;
    quads_.add(bits(tap.along), bits(tap.wu), bits(tap.wv), bits(offset));
  }
  return start;
}

// Two quads per row, cell, place between scanned lines and segment: taps and their number,
// intervals and theirs; slopes.
void FarFieldTables::add_reads(const PlaneShape& p, const Direction& d, const StripLevels& levels,
                               int direction_quad, std::vector<int>* restarts) {
  const LineLayout layout(p.width, p.height, d, settings_.line_step);
  std::vector<std::vector<int>> taps;
  for (const auto& segments : d.segments) {
    taps.emplace_back();
    for (const Segment& s : segments) taps.back().push_back(add_taps(p, d, s));
  }
  const int headers = quads_.size(), cells = static_cast<int>(d.segments.size());
  quads_.set(direction_quad + 1, 1, headers);
  const int count = p.visible.height * cells * settings_.line_step * settings_.segments;
  for (int i = 0; i < 2 * count; ++i) quads_.add(0, 0, 0, 0);
  int header = headers;
  for (int y = 0; y < p.visible.height; ++y) {
    const int v = y + p.top, row = d.sign > 0 ? v : p.height - 1 - v;
    const int near = far_field::near_rows(d, settings_.interval, row, p.height);
    for (int k = 0; k < cells * settings_.line_step; ++k) {
      const int cell = k / settings_.line_step, u = p.left + k % settings_.line_step;
      const std::vector<Segment>& segments = d.segments[cell];
      for (std::size_t s = 0; s < segments.size(); ++s, header += 2) {
        const Segment& segment = segments[s];
        const int start = quads_.size();
        const int found = add_intervals(d, segment, layout, levels, row, u, restarts);
        quads_.set(header, 0, taps[cell][s]);
        quads_.set(header, 1, far_field::count_taps(segment, row, near, p.height) | found << 16);
        quads_.set(header, 2, start);
        quads_.set(header + 1, 0, std::bit_cast<int>(segment.low));
        quads_.set(header + 1, 1, std::bit_cast<int>(segment.middle));
        quads_.set(header + 1, 2, std::bit_cast<int>(segment.high));
        quads_.set(header + 1, 3, std::bit_cast<int>(far_field::dither(d, segment)));
      }
    }
  }
  for (int i = headers + 2 * count; i < quads_.size(); ++i) {
    const int strip = quads_.get(i, 0) & 0xFFFFFF, level = quads_.get(i, 0) >> 24;
    quads_.set(i, 0, strip | (*restarts)[level] << 24);
  }
}

int FarFieldTables::add_intervals(const Direction& d, const Segment& segment,
                                  const LineLayout& layout, const StripLevels& levels, int row,
                                  int u, std::vector<int>* restarts) {
  IntervalLines found[far_field::kMaxIntervals];
  const int count = far_field::find_intervals(d, segment, layout, levels,
                                              far_field::Climb(settings_), row, u, found);
  for (int i = 0; i < count; ++i) {
    const IntervalLines& f = found[i];
    const int lines = f.last + 1 - f.first;
    int& restart = (*restarts)[f.level];
    while (lines > 1 << restart) ++restart;
    quads_.add(bits(levels.index(f.level, f.strip) | f.level << 24),
               bits(finite() ? f.middle : f.first),
               finite() ? bits(static_cast<float>(f.away)) : bits(f.last + 1),
               bits(1.0f / static_cast<float>(lines)));
  }
  return count;
}

void FarFieldTables::make_tables(Batch* batch) {
  Batch& b = *batch;
  const PlaneShape& p = *b.plane;
  b.table = quads_.size();
  for (std::size_t i = 0; i < 4 * b.directions.size(); ++i) quads_.add(0, 0, 0, 0);
  std::vector<std::array<std::uint32_t, 4>> strips;
  int raw_base = 0, sum_base = 0, quad = b.table;
  for (const Direction* d : b.directions) {
    const LineLayout layout(p.width, p.height, *d, settings_.line_step);
    const StripLevels levels(p.height, d->strip_offset, settings_.interval);
    for (const auto& [word, value] :
         {std::pair{0, d->sign}, {1, d->share}, {2, d->strip_offset}, {3, layout.lines}}) {
      quads_.set(quad, word, value);
    }
    quads_.set(quad + 1, 0, quads_.size());
    quads_.set(quad + 1, 2, finite() ? raw_base : sum_base);
    add_shifts(layout, p.height);
    for (int level = 0; level < std::min(levels.levels(), kSharedLevels); ++level) {
      quads_.set(quad + 2, level, levels.strips(level));
      quads_.set(quad + 3, level, raw_base + levels.start[level]);
    }
    std::vector<int> restarts(levels.levels(), kLeastRestart);
    add_reads(p, *d, levels, quad, &restarts);
    for (int level = 0; level < (finite() ? 0 : levels.levels()); ++level) {
      const int shared = std::min(level, kSharedLevels - 1), merged = 1 << (level - shared);
      for (int strip = 0; strip < levels.strips(level); ++strip) {
        const int first = strip * merged;
        const int count = std::min(merged, levels.strips(shared) - first);
        strips.push_back({bits(raw_base + levels.start[shared] + first), bits(count),
                          bits(layout.lines), bits(restarts[level])});
      }
    }
    raw_base += raw_rows(levels);
    sum_base += sum_rows(levels);
    quad += 4;
  }
  if (finite()) add_merges(&b);
  b.rows_table = quads_.size();
  for (const auto& s : strips) quads_.add(s[0], s[1], s[2], s[3]);
  b.table_bytes = std::uint64_t{16} * (quads_.size() - b.table);
}

// Per level beyond the scan's, for each direction: its first strip and their number, and the same
// of the level below.
void FarFieldTables::add_merges(Batch* batch) {
  int deepest = 0;
  std::vector<StripLevels> pyramids;
  for (const Direction* d : batch->directions) {
    pyramids.emplace_back(batch->plane->height, d->strip_offset, settings_.interval);
    deepest = std::max(deepest, pyramids.back().levels());
  }
  for (int level = kSharedLevels; level < deepest; ++level) {
    batch->merges.push_back(quads_.size());
    int base = 0;
    for (const StripLevels& p : pyramids) {
      if (level < p.levels()) {
        quads_.add(bits(base + p.start[level]), bits(p.strips(level)),
                   bits(base + p.start[level - 1]), bits(p.strips(level - 1)));
      } else {
        quads_.add(0, 0, 0, 0);
      }
      base += p.all();
    }
  }
}

// Two rows per quad: where line 0 crosses them, in whole texels and what is left.
void FarFieldTables::add_shifts(const LineLayout& layout, int height) {
  auto at = [&](int row) {
    const double shift = layout.shift(row), whole = std::floor(shift);
    return std::pair{bits(static_cast<int>(whole)), bits(static_cast<float>(shift - whole))};
  };
  for (int row = 0; row < height; row += 2) {
    const auto [a, b] = at(row);
    const auto [c, d] = at(row + 1);
    quads_.add(a, b, c, d);
  }
}

}  // namespace obscura::gpu
