#ifndef OBSCURA_SRC_SCREEN_REFERENCE_PLAN_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_PLAN_H_

#include "math/falloff.h"
#include "obscura/reference.h"

namespace obscura {

// The ray-traced reference; settings and guarantees: obscura/reference.h.
struct ReferencePlan {
  math::Rho rho;
  float reach = 0;  // world units; rho is 0 beyond, or less than half the last place of 1
};

// Checks the settings and prepares what does not change from frame to frame.
Status make_plan(const ReferenceSettings& settings, ReferencePlan* plan);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_PLAN_H_
