#include "screen/horizon/horizon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "screen/horizon/horizon_kernel.h"
#include "screen/rows.h"

namespace obscura {
namespace {

// Matter whose weight is below this is not looked for.
constexpr float kLeastWeight = 0.04f;

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
  HorizonMethod(const HorizonSettings& settings, math::Rho rho)
      : classic_(settings.variant == HorizonVariant::kClassic), rho_(std::move(rho)) {
    frame_.rho = &rho_;
    frame_.reach = classic_ ? settings.falloff.radius : reach_of(rho_);
    frame_.directions = settings.directions;
    frame_.steps = settings.steps;
    frame_.interleave = settings.interleave;
    frame_.chord = settings.profile == SlabProfile::kAdaptiveChord;
    frame_.bias_sine = std::sin(settings.angle_bias);
    frame_.bias_cosine = std::cos(settings.angle_bias);
    set_pattern(settings, &frame_);
  }

  view::Needs needs() const override { return {.normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    frame_.view = view::make_tap_frame(g, frame_.reach);
    const auto kernel = classic_ ? horizon::classic_row : horizon::slices_row;
    return run_rows(g, outputs.visibility, context, [&](int row, int begin, int end, float* out) {
      kernel(frame_, row, begin, end, out);
    });
  }

 private:
  const bool classic_;
  const math::Rho rho_;
  horizon::Frame frame_;
};

}  // namespace

Status make_horizon(const HorizonSettings& settings, std::unique_ptr<Method>* method) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  if (settings.variant == HorizonVariant::kClassic && !std::isfinite(settings.falloff.radius)) {
    return invalid_argument("radius is inf; the classic horizon method needs a finite one");
  }
  math::Rho rho;
  if (Status s = math::make_rho(settings.falloff, &rho); !s.ok()) return s;
  *method = std::make_unique<HorizonMethod>(settings, std::move(rho));
  return {};
}

}  // namespace obscura
