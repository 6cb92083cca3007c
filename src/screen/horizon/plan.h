#ifndef OBSCURA_SRC_SCREEN_HORIZON_PLAN_H_
#define OBSCURA_SRC_SCREEN_HORIZON_PLAN_H_

#include <memory>

#include "math/falloff.h"
#include "obscura/horizon.h"
#include "screen/horizon/kernel.h"
#include "screen/method.h"

namespace obscura {

// Horizon-based ambient obscurance; settings and paper: obscura/horizon.h. `width` x `height` is
// the whole depth image.
Status make_horizon(const HorizonSettings& settings, int width, int height,
                    std::unique_ptr<Method>* method);

// Checks the settings and prepares what does not change from frame to frame.
Status make_horizon_frame(const HorizonSettings& settings, math::Rho* rho, horizon::Frame* frame);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_HORIZON_PLAN_H_
