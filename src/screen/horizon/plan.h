#ifndef OBSCURA_SRC_SCREEN_HORIZON_PLAN_H_
#define OBSCURA_SRC_SCREEN_HORIZON_PLAN_H_

#include "math/falloff.h"
#include "obscura/horizon.h"
#include "screen/horizon/kernel.h"

namespace obscura {

// Horizon-based ambient obscurance; settings and paper: obscura/horizon.h.
struct HorizonPlan {
  math::Rho rho;
  horizon::Frame frame;  // its view and rho are each frame's own
};

// Checks the settings and prepares what does not change from frame to frame, on any device.
Status make_plan(const HorizonSettings& settings, HorizonPlan* plan);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_HORIZON_PLAN_H_
