#include "screen/horizon/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "filters/interleaved/interleaved.h"
#include "screen/horizon/kernel.h"

namespace obscura {
namespace {

// Matter whose weight is below this is not looked for.
constexpr float kLeastWeight = 0.04f;
constexpr int kRowsPerTask = 8;

// Where rho has fallen to kLeastWeight, to a per cent of that length.
float reach_of(const math::Rho& rho) {
  float low = 0, high = 1e-30f;
  while (math::evaluate(rho, high) > kLeastWeight) {
    low = high;
    high *= 2;
    if (high > 1e30f) return 1e30f;
  }
  while (high > 1.01f * low) {
    const float middle = 0.5f * (low + high);
    (math::evaluate(rho, middle) > kLeastWeight ? low : high) = middle;
    if (high < 1e-29f) break;
  }
  return high;
}

std::vector<int> shuffled(int count, Random* random) {
  std::vector<int> order(count);
  for (int i = 0; i < count; ++i) {
    const int j = random->below(i + 1);
    order[i] = order[j];
    order[j] = i;
  }
  return order;
}

// Each pixel of the tile turns the directions by its own part of the angle between two of them and
// shifts the samples by its own part of a step.
void set_pattern(const HorizonSettings& s, horizon::Frame* f) {
  const double between = 2 * std::numbers::pi / s.directions;
  for (int k = 0; k < s.directions; ++k) {
    f->cosine[k] = static_cast<float>(std::cos(between * k));
    f->sine[k] = static_cast<float>(std::sin(between * k));
    f->shift[k] = static_cast<float>(std::fmod(k * 0.6180339887498949, 1.0));
  }
  const int m = s.interleave, cells = m * m;
  Random random(s.seed);
  const std::vector<int> turns = shuffled(cells, &random), shifts = shuffled(cells, &random);
  for (int cell = 0; cell < cells; ++cell) {
    const double turn = between * (turns[cell] + 0.5) / cells;
    const double values[] = {std::cos(turn), std::sin(turn), (shifts[cell] + 0.5) / cells};
    for (int v = 0; v < horizon::kTileValues; ++v) {
      for (int x = cell % m; x < horizon::kTileRow; x += m) {
        f->tile[v][cell / m][x] = static_cast<float>(values[v]);
      }
    }
  }
}

class HorizonMethod final : public Method {
 public:
  HorizonMethod(const HorizonSettings& settings, math::Rho rho, const horizon::Frame& frame,
                int width, int height)
      : settings_(settings), rho_(std::move(rho)), frame_(frame) {
    frame_.rho = &rho_;
    sums_.resize(width, height);
  }

  view::Needs needs() const override { return {.normals = true}; }
  OutputKinds output_kinds() const override {
    return {.bent_normal = true,
            .cone_angle = true,
            .uniform_integral = true,
            .cosine_integral = !classic()};
  }

  Status run(const view::Geometry& g, const Outputs& o, const RunContext& context) override {
    frame_.view = view::make_tap_frame(g, frame_.reach);
    Outputs left = o;
    if (!o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty()) {
      const Sums sums = classic() ? Sums::kUniform : Sums::kUniformDirections;
      if (Status s = pass(g, left, sums, true, context); !s.ok()) return s;
      left.visibility = {};
    }
    if (left.visibility.empty() && o.cosine_integral.empty()) return {};
    const Sums sums = classic() ? Sums::kUniform : Sums::kCosine;
    return pass(g, left, sums, !o.cosine_integral.empty(), context);
  }

 private:
  using Sums = interleaved::Sums;

  bool classic() const { return settings_.variant == HorizonVariant::kClassic; }
  bool blurred() const { return settings_.blur && settings_.interleave > 1; }

  // Sums of one kind, their blur, and the results that come from them.
  Status pass(const view::Geometry& g, const Outputs& o, Sums kind, bool directions,
              const RunContext& context) {
    const int width = g.visible_width(), height = g.visible_height();
    const int channels = directions ? interleaved::kChannels : 1;
    const SliceSums slice_sums = !directions             ? SliceSums::kVisibility
                                 : kind == Sums::kCosine ? SliceSums::kCosine
                                                         : SliceSums::kUniform;
    Progress progress(height, context.progress);
    auto sum_rows = [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        float* out[interleaved::kChannels] = {};
        for (int c = 0; c < channels; ++c) out[c] = sums_.row(c, y);
        classic() ? horizon::classic_row(frame_, y, width, out)
                  : horizon::slices_row(frame_, slice_sums, y, width, out);
        sums_.close_row(channels, width, y);
      }
    };
    context.timer.time("sample", [&] {
      const int tasks = (height + kRowsPerTask - 1) / kRowsPerTask;
      context.executor.parallel_for(tasks, [&](int task, int) {
        if (progress.cancelled()) return;
        const int first = task * kRowsPerTask, end = std::min(height, first + kRowsPerTask);
        sum_rows(first, end);
        progress.advance(end - first);
      });
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    // A radius without end tells nothing of where one surface ends and another begins.
    const float edge = std::min(rho_.radius, horizon::kLongestEdge * g.max_depth);
    context.timer.time("blur", [&] {
      sums_.resolve(g,
                    {.sums = kind,
                     .directions = directions,
                     .interleave = blurred() ? settings_.interleave : 1,
                     .edge = std::max(0.5f * edge, 1e-30f),
                     .paper_cone = settings_.cone == ConeEstimate::kPaper},
                    o, context.executor);
    });
    return {};
  }

  const HorizonSettings settings_;
  const math::Rho rho_;
  horizon::Frame frame_;
  interleaved::InterleavedSums sums_;
};

}  // namespace

Status make_horizon_frame(const HorizonSettings& settings, math::Rho* rho, horizon::Frame* f) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  const bool classic = settings.variant == HorizonVariant::kClassic;
  if (classic && !std::isfinite(settings.falloff.radius)) {
    return invalid_argument("radius is inf; the classic horizon method needs a finite one");
  }
  if (Status s = math::make_rho(settings.falloff, rho); !s.ok()) return s;
  f->reach = classic ? settings.falloff.radius : reach_of(*rho);
  f->chord = settings.profile == SlabProfile::kAdaptiveChord;
  f->directions = settings.directions;
  f->steps = settings.steps;
  f->interleave = settings.interleave;
  f->bias_sine = std::sin(settings.angle_bias);
  f->bias_cosine = std::cos(settings.angle_bias);
  set_pattern(settings, f);
  return {};
}

Status make_horizon(const HorizonSettings& settings, int width, int height,
                    std::unique_ptr<Method>* method) {
  math::Rho rho;
  horizon::Frame frame;
  if (Status s = make_horizon_frame(settings, &rho, &frame); !s.ok()) return s;
  *method = std::make_unique<HorizonMethod>(settings, std::move(rho), frame, width, height);
  return {};
}

}  // namespace obscura
