#include "screen/far_field/far_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/text.h"
#include "screen/far_field/directions.h"
#include "screen/far_field/plane.h"
#include "screen/far_field/scan.h"
#include "screen/far_field/slices.h"

namespace obscura {

bool SettingText<NearStep>::parse(std::string_view text, NearStep* value) {
  if (text == "adaptive") {
    *value = NearStep::adaptive();
    return true;
  }
  double number;
  if (!parse_number(text, &number) || !closed(0.125, 8).contains(number)) return false;
  *value = NearStep::of(static_cast<float>(number));
  return true;
}
std::string SettingText<NearStep>::write(const NearStep& value) {
  return value.px > 0 ? write_number(value.px, true) : "adaptive";
}

namespace far_field {
namespace {

constexpr int kRowsPerTask = 8;
constexpr int kMaxIntervals = 64;

// Which intervals a segment reads for the receivers of row `row` (counted outwards): the nearest is
// at least one interval away; every second one climbs a level of the pyramid (section 6).
int list_intervals(const Direction& direction, const Segment& segment, const LineLayout& layout,
                   int interval, int row, bool finite, ScanBuffer* buffer, IntervalRead* reads) {
  int count = 0, level = 0;
  int strip = (row + direction.phase + 2 * interval - 1) / interval;
  while (strip < buffer->strips(level) && count < kMaxIntervals) {
    const double size = static_cast<double>(interval) * (1 << level);
    const double away = (strip + 0.5) * size - 0.5 - direction.phase - row;
    const double shift = layout.shift(row + away);
    int first = static_cast<int>(std::ceil(segment.low * away - shift));
    int last = static_cast<int>(std::floor(segment.high * away - shift));
    if (first > last) {
      first = last = static_cast<int>(std::floor(segment.middle * away - shift + 0.5));
    }
    IntervalRead& read = reads[count++];
    read = {.sums = {},
            .first = first,
            .last = last + 1,
            .inverse_lines = static_cast<float>(1.0 / (last + 1 - first)),
            .nearest = nullptr,
            .slanted = nullptr,
            .deepest = nullptr,
            .middle = static_cast<int>(std::floor(segment.middle * away - shift + 0.5))};
    if (finite) {
      read.nearest = buffer->nearest(level, strip);
      read.slanted = buffer->slanted(level, strip);
      read.deepest = buffer->deepest(level, strip);
    } else {
      read.sums = buffer->sums(level, strip);
    }
    ++strip;
    if (strip % 2 == 0 && level + 1 < buffer->levels()) {
      strip /= 2;
      ++level;
    }
  }
  return count;
}

// The same for a slice and its mirror image.
float dither(const Direction& direction, const Segment& segment) {
  const double x = 5.3 * std::abs(segment.middle) + 0.37 * direction.transposed;
  return static_cast<float>(x - std::floor(x) - 0.5);
}

class FarFieldMethod final : public Method {
 public:
  FarFieldMethod(const FarFieldSettings& settings, math::Rho rho)
      : settings_(settings), rho_(std::move(rho)), directions_(make_directions(settings)) {
    margin_ = sideways_reach(directions_, settings.interval) + 2 * PrefixSums::kPadding;
  }

  view::Needs needs() const override {
    return {.normals = true, .back_depth = settings_.occluder.kind == OccluderKind::kBackDepth};
  }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    Executor& executor = context.executor;
    for (bool transposed : {false, true}) {
      fill_plane(g, settings_.occluder, transposed, margin_, executor, &planes_[transposed]);
    }
    Progress progress(static_cast<std::int64_t>(directions_.size()), context.progress);
    for (const Direction& direction : directions_) {
      Plane& plane = planes_[direction.transposed];
      scan(plane, direction, settings_.interval, settings_.receiver_slope, executor, &buffer_);
      evaluate(direction, executor, &plane);
      if (!progress.advance()) return {StatusCode::kCancelled, "stopped by the caller"};
    }
    write(executor, outputs.visibility);
    return {};
  }

 private:
  void evaluate(const Direction& direction, Executor& executor, Plane* plane) {
    Plane& p = *plane;
    const LineLayout layout(p, direction);
    const int rows = p.visible_height;
    executor.parallel_for((rows + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
      IntervalRead reads[kMaxIntervals];
      for (int y = task * kRowsPerTask; y < std::min(rows, (task + 1) * kRowsPerTask); ++y) {
        const int v = y + p.top, row = direction.sign > 0 ? v : p.height - 1 - v;
        const int interval = settings_.interval;
        const int first_strip = (row + direction.phase + 2 * interval - 1) / interval;
        const int near_rows = std::min(first_strip * interval - direction.phase, p.height) - row;
        for (const Segment& segment : direction.segments) {
          SliceRow job{.plane = &p,
                       .rho = &rho_,
                       .chord = settings_.profile == SlabProfile::kAdaptiveChord,
                       .partial = true,
                       .sign = direction.sign,
                       .row = y,
                       .segment = &segment,
                       .lines = layout.lines,
                       .tap_count = 0,
                       .intervals = reads,
                       .interval_count = 0,
                       .slope = settings_.receiver_slope < 0 ? 1.0f : -1.0f,
                       .slack = join_slack(p),
                       .dither = dither(direction, segment)};
          while (job.tap_count < static_cast<int>(segment.taps.size())) {
            const NearTap& tap = segment.taps[job.tap_count];
            if (tap.along >= near_rows || row + tap.dv + (tap.wv > 0 ? 1 : 0) >= p.height) break;
            ++job.tap_count;
          }
          job.interval_count =
              list_intervals(direction, segment, layout, interval, row, p.finite, &buffer_, reads);
          p.finite ? add_matter_slices(job, p.obscurance.row(y))
                   : add_slices(job, p.obscurance.row(y));
        }
      }
    });
  }

  void write(Executor& executor, const ImageView<float>& out) const {
    const Plane& a = planes_[0];
    const Plane& b = planes_[1];
    constexpr int kTile = 32;
    executor.parallel_for((out.height + kTile - 1) / kTile, [&](int task, int) {
      const int y0 = task * kTile, y1 = std::min(out.height, y0 + kTile);
      for (int x0 = 0; x0 < out.width; x0 += kTile) {
        for (int y = y0; y < y1; ++y) {
          for (int x = x0; x < std::min(out.width, x0 + kTile); ++x) {
            const float sum = a.obscurance(x, y) + b.obscurance(y, x);
            out(x, y) = std::clamp(1 - sum * std::numbers::inv_pi_v<float>, 0.0f, 1.0f);
          }
        }
      }
    });
  }

  const FarFieldSettings settings_;
  const math::Rho rho_;
  const std::vector<Direction> directions_;
  int margin_ = 0;
  Plane planes_[2];
  ScanBuffer buffer_;
};

}  // namespace
}  // namespace far_field

namespace {

FarFieldSettings with_preset(FarFieldSettings s) {
  switch (s.preset) {
    case FarFieldPreset::kNone:
      break;
    case FarFieldPreset::kFast:
      s.directions = 8;
      s.segments = 1;
      s.near_step = NearStep::of(1);
      break;
    case FarFieldPreset::kBalanced:
      s.directions = 8;
      s.segments = 2;
      s.near_step = NearStep::of(1);
      break;
    case FarFieldPreset::kHigh:
      s.directions = 24;
      s.segments = 2;
      s.near_step = NearStep::of(0.25f);
      break;
  }
  return s;
}

}  // namespace

Status make_far_field(const FarFieldSettings& given, std::unique_ptr<Method>* method) {
  const FarFieldSettings settings = with_preset(given);
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  if (Status s = validate(settings.occluder); !s.ok()) return s;
  if (settings.receiver_slope == 0) {
    return invalid_argument("receiver_slope is 0; it must be -1 or 1");
  }
  const float step = settings.near_step.px;
  if (step != 0 && !(step >= 0.125f && step <= 8)) {
    return invalid_argument(
        text("near_step is ", step, "; it must be in [0.125, 8], or 0 for adaptive"));
  }
  if (settings.occluder.kind == OccluderKind::kLayers) {
    return unsupported("the far field takes the occluders solid, thickness and back-depth");
  }
  math::Rho rho;
  if (Status s = math::make_rho(settings.falloff, &rho); !s.ok()) return s;
  *method = std::make_unique<far_field::FarFieldMethod>(settings, std::move(rho));
  return {};
}

}  // namespace obscura
