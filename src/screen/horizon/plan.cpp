#include "screen/horizon/plan.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"

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
      f->tile[v][cell / m][cell % m] = static_cast<float>(values[v]);
    }
  }
}

}  // namespace

Status make_plan(const HorizonSettings& settings, HorizonPlan* plan) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  if (Status s = validate(settings.occluder); !s.ok()) return s;
  const OccluderKind occluder = settings.occluder.kind;
  if (occluder == OccluderKind::kLayers) {
    return unsupported("horizon takes the occluders auto, solid, thickness and back-depth");
  }
  const bool classic = settings.variant == HorizonVariant::kClassic;
  if (classic && occluder != OccluderKind::kSolid && occluder != OccluderKind::kAuto) {
    return unsupported("the classic horizon method takes matter as solid: occluder solid or auto");
  }
  if (classic && !std::isfinite(settings.falloff.radius)) {
    return invalid_argument("radius is inf; the classic horizon method needs a finite one");
  }
  if (Status s = math::make_rho(settings.falloff, &plan->rho); !s.ok()) return s;
  horizon::Frame& f = plan->frame;
  f.reach = classic ? settings.falloff.radius : reach_of(plan->rho);
  f.chord = settings.profile == SlabProfile::kAdaptiveChord;
  f.matter = classic ? view::Matter::kSolid : view::matter_of(settings.occluder);
  f.thickness = settings.occluder.thickness;
  f.directions = settings.directions;
  f.steps = settings.steps;
  f.interleave = settings.interleave;
  f.bias_sine = std::sin(settings.angle_bias);
  f.bias_cosine = std::cos(settings.angle_bias);
  set_pattern(settings, &f);
  return {};
}

}  // namespace obscura
