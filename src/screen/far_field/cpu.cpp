#include "screen/far_field/plan.h"

#include <algorithm>
#include <cmath>

#include "screen/far_field/lines.h"
#include "screen/far_field/plane.h"
#include "screen/far_field/scan.h"
#include "screen/far_field/share.h"
#include "screen/far_field/slices.h"
#include "screen/far_field/totals.h"
#include "screen/method.h"

namespace obscura {

namespace far_field {
namespace {

constexpr int kRowsPerTask = 8;

// The intervals of a segment for receivers of a row whose first is at texel u.
int list_intervals(const Direction& direction, const Segment& segment, const LineLayout& layout,
                   const Climb& climb, int row, int u, bool finite, ScanBuffer* buffer,
                   IntervalRead* reads) {
  IntervalLines found[kMaxIntervals];
  const int count =
      find_intervals(direction, segment, layout, buffer->pyramid(), climb, row, u, found);
  const int phases = buffer->phases();
  // Of a line: its phase and its place among that phase's lines, also left of the first line.
  auto phase_of = [&](int line) { return ((line % phases) + phases) % phases; };
  auto place_of = [&](int line) { return (line - phase_of(line)) / phases; };
  for (int i = 0; i < count; ++i) {
    const auto& [level, strip, first, last, middle, away] = found[i];
    reads[i] = {.from = {},
                .to = {},
                .first = place_of(first),
                .last = place_of(last + 1),
                .inverse_lines = static_cast<float>(1.0 / (last + 1 - first)),
                .line = {},
                .middle = place_of(middle),
                .away = static_cast<float>(away)};
    if (finite) {
      reads[i].line = buffer->raw(level, strip, phase_of(middle));
    } else {
      reads[i].from = buffer->sums(level, strip, phase_of(first));
      reads[i].to = buffer->sums(level, strip, phase_of(last + 1));
    }
  }
  return count;
}

// The near field's samples for receivers whose first is at texel u.
void list_taps(const Plane& p, const Direction& direction, const Segment& segment, int u,
               std::vector<TapRead>* taps) {
  taps->clear();
  for (const NearTap& tap : segment.taps) {
    const std::ptrdiff_t step = direction.sign * p.lattice.stride();
    const std::ptrdiff_t upper = tap.dv * step, lower = tap.wv > 0 ? upper + step : upper;
    const std::ptrdiff_t left = p.lattice.offset(u + tap.du);
    const std::ptrdiff_t right = p.lattice.offset(u + tap.du + 1);
    taps->push_back({.upper = upper + left,
                     .upper_next = upper + right,
                     .lower = lower + left,
                     .lower_next = lower + right,
                     .wu = tap.wu,
                     .wv = tap.wv,
                     .along = tap.along});
  }
}

class FarFieldMethod final : public Method {
 public:
  explicit FarFieldMethod(FarFieldPlan plan)
      : plan_(std::move(plan)), margin_(plan_.reach + 2 * PrefixSums::kPadding * phases_) {}

  view::Needs needs() const override {
    return view::Needs{.normals = true}.with(settings_.occluder, false);
  }
  OutputKinds output_kinds() const override {
    return {
        .bent_normal = true, .cone_angle = true, .uniform_integral = true, .cosine_integral = true};
  }

  Status run(const view::Geometry& g, const Outputs& o, const RunContext& context) override {
    wanted_ = {
        .uniform = !o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty(),
        .cosine = !o.cosine_integral.empty()};
    if (o.visibility.empty() && !wanted_.uniform && !wanted_.cosine) return {};
    Executor& executor = context.executor;
    const PassTimer& timer = context.timer;
    if (settings_.separable > 1) timer.time("share", [&] { shared_.prepare(g, executor); });
    timer.time("fill", [&] { prepare(g, executor); });
    Progress progress(static_cast<std::int64_t>(plan_.directions.size()), context.progress);
    const ScanSettings scan_settings{settings_.interval, settings_.receiver_slope,
                                     settings_.line_step};
    for (const Direction& direction : plan_.directions) {
      Plane& plane = planes_[direction.transposed];
      timer.time("scan", [&] { scan(plane, direction, scan_settings, executor, &buffer_); });
      timer.time("sum", [&] { sum(plane, direction, scan_settings, executor, &buffer_); });
      timer.time("evaluate", [&] { evaluate(direction, executor, &plane); });
      if (!progress.advance()) return {StatusCode::kCancelled, "stopped by the caller"};
    }
    timer.time("collect", [&] { collect(planes_, wanted_, executor, &totals_); });
    if (settings_.separable > 1) {
      timer.time("gather", [&] { shared_.gather(g, wanted_, executor, &totals_, &spare_); });
    }
    if (settings_.jitter && settings_.blur) {
      timer.time("blur", [&] { blur_selectively(g, wanted_, executor, &totals_, &spare_); });
    }
    timer.time("write", [&] { finish(g, totals_, settings_.cone, executor, o); });
    return {};
  }

 private:
  void prepare(const view::Geometry& g, Executor& executor) {
    for (bool transposed : {false, true}) {
      Plane& p = planes_[transposed];
      fill_plane(g, settings_.occluder, transposed, margin_, phases_, executor, &p);
      fill_receivers(g, transposed, executor, &p);
      for (Channel c : wanted_.channels()) {
        p.sums.clear(c, p.visible_width, p.visible_height, phases_, executor);
      }
    }
  }

  const std::vector<TapRead>& taps_of(int row, int phase, std::size_t segment) const {
    return taps_[((settings_.jitter ? row % 3 : 0) * phases_ + phase) * settings_.segments +
                 segment];
  }
  void prepare_taps(const Direction& direction, const Plane& p) {
    const int row_cells = settings_.jitter ? 3 : 1;
    taps_.resize(static_cast<std::size_t>(row_cells) * phases_ * settings_.segments);
    auto taps = taps_.begin();
    for (int row = 0; row < row_cells; ++row) {
      for (int phase = 0; phase < phases_; ++phase) {
        for (const Segment& segment :
             direction.segments_of(cell_of(direction, side_, row, phase))) {
          list_taps(p, direction, segment, phase + p.left, &*taps++);
        }
      }
    }
  }

  void evaluate(const Direction& direction, Executor& executor, Plane* plane) {
    const LineLayout layout(plane->width, plane->height, direction, settings_.line_step);
    const int rows = plane->visible_height, phases = std::min(phases_, plane->visible_width);
    prepare_taps(direction, *plane);
    executor.parallel_for((rows + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
      const int end = std::min(rows, (task + 1) * kRowsPerTask);
      for (int y = task * kRowsPerTask; y < end; ++y) {
        for (int phase = 0; phase < phases; ++phase) {
          const int count = (plane->visible_width - phase + phases_ - 1) / phases_;
          auto run = [&](int begin, int receivers_end) {
            evaluate_row(direction, layout, y, phase, begin, receivers_end, plane);
          };
          if (settings_.separable == 1) {
            run(0, count);
          } else {
            shared_.for_receivers(direction, cell_of(direction, side_, y, phase), y, count, run);
          }
        }
      }
    });
  }

  // Receivers from `begin` to `end` of a row's phase.
  void evaluate_row(const Direction& direction, const LineLayout& layout, int y, int phase,
                    int begin, int end, Plane* plane) {
    Plane& p = *plane;
    const int v = y + p.top, u = phase + p.left, row = direction.sign > 0 ? v : p.height - 1 - v;
    const int interval = settings_.interval;
    const int near = near_rows(direction, interval, row, p.height);
    const int cell = cell_of(direction, side_, y, phase);
    const std::vector<Segment>& segments = direction.segments_of(cell);
    IntervalRead intervals[kMaxIntervals];
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Segment& segment = segments[i];
      SliceRow job{.plane = &p,
                   .rho = &plan_.rho,
                   .sums = SliceSums::kVisibility,
                   .chord = settings_.profile == SlabProfile::kAdaptiveChord,
                   .sign = direction.sign,
                   .row = y,
                   .column = phase,
                   .begin = begin,
                   .count = end,
                   .segment = &segment,
                   .texels = p.lattice.row(v),
                   .backs = p.finite ? p.back.row(v) : nullptr,
                   .taps = taps_of(y, phase, i).data(),
                   .tap_count = count_taps(segment, row, near, p.height),
                   .intervals = intervals,
                   .interval_count = list_intervals(direction, segment, layout, Climb(settings_),
                                                    row, u, p.finite, &buffer_, intervals),
                   .slope = settings_.receiver_slope < 0 ? 1.0f : -1.0f,
                   .slack = join_slack(p),
                   .dither = dither(direction, segment),
                   .out = {}};
      add(job, &p.sums);
    }
  }

  // The sums that are wanted, in one run over the slice or in two.
  void add(SliceRow job, SumImages* to) {
    auto row = [&](int channel) { return to->channel[channel].at(job.row, job.column); };
    auto run = [&](SliceSums sums, bool obscurance, int vector) {
      job.sums = sums;
      job.out[0] = obscurance ? row(kObscurance) : nullptr;
      for (int i = 0; vector != kObscurance && i < (sums == SliceSums::kUniform ? 4 : 3); ++i) {
        job.out[1 + i] = row(vector + i);
      }
      job.plane->finite ? add_matter_slices(job) : add_slices(job);
    };
    if (wanted_.uniform) run(SliceSums::kUniform, true, kUniformVector);
    if (wanted_.cosine) run(SliceSums::kCosine, !wanted_.uniform, kCosineVector);
    if (!wanted_.uniform && !wanted_.cosine) run(SliceSums::kVisibility, true, kObscurance);
  }

  const FarFieldPlan plan_;
  const FarFieldSettings& settings_ = plan_.settings;
  const int side_ = group_side(settings_), phases_ = plan_.phases, margin_;
  SharedWork shared_{side_, phases_};
  WantedSums wanted_;
  Plane planes_[2];
  Totals totals_, spare_;
  ScanBuffer buffer_;
  std::vector<std::vector<TapRead>> taps_;  // of one direction; see taps_of()
};

}  // namespace
}  // namespace far_field

template <>
Status make_method(const FarFieldSettings& settings, int, int, std::unique_ptr<Method>* method) {
  FarFieldPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  *method = std::make_unique<far_field::FarFieldMethod>(std::move(plan));
  return {};
}

}  // namespace obscura
