#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_PLAN_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_PLAN_H_

#include <vector>

#include "math/falloff.h"
#include "obscura/far_field.h"
#include "screen/far_field/directions.h"

namespace obscura {

// Far-field ambient obscurance; settings and paper: obscura/far_field.h.
struct FarFieldPlan {
  FarFieldSettings settings;  // with the preset's in their place
  math::Rho rho;
  std::vector<far_field::Direction> directions;
  int phases = 1;  // see far_field::phases_of
  int reach = 0;   // the farthest that a tap or an interval lies sideways, in texels
};

// Checks the settings and prepares what does not change from frame to frame, on any device.
Status make_plan(const FarFieldSettings& settings, FarFieldPlan* plan);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_PLAN_H_
