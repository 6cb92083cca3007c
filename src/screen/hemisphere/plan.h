#ifndef OBSCURA_SRC_SCREEN_HEMISPHERE_PLAN_H_
#define OBSCURA_SRC_SCREEN_HEMISPHERE_PLAN_H_

#include "obscura/hemisphere.h"
#include "screen/hemisphere/kernel.h"

namespace obscura {

// Checks the settings and prepares what does not change from frame to frame, on any device: sizes
// and pattern of the frame, not its view and light.
Status make_plan(const HemisphereSettings& settings, hemisphere::Frame* frame);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_HEMISPHERE_PLAN_H_
