#include "screen/reference/plan.h"

#include <limits>

namespace obscura {
namespace {

// The distance beyond which rho is 0, or less than half the last place of 1.
float reach_of(const Falloff& falloff) {
  switch (falloff.kind) {
    case FalloffKind::kConstant:
    case FalloffKind::kQuadratic:
    case FalloffKind::kTable:
      return falloff.radius;
    case FalloffKind::kExponential:
      return 17 * falloff.radius;
    case FalloffKind::kInverseSquare:
      return 5000 * falloff.radius;
    case FalloffKind::kFunction:
      break;
  }
  return std::numeric_limits<float>::infinity();
}

}  // namespace

Status validate(const ReferenceSettings& settings) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  return validate(settings.occluder);
}

Status make_plan(const ReferenceSettings& settings, ReferencePlan* plan) {
  if (Status s = validate(settings); !s.ok()) return s;
  plan->reach = reach_of(settings.falloff);
  return math::make_rho(settings.falloff, &plan->rho);
}

}  // namespace obscura
