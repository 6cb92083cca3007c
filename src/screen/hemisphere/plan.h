#ifndef OBSCURA_SRC_SCREEN_HEMISPHERE_PLAN_H_
#define OBSCURA_SRC_SCREEN_HEMISPHERE_PLAN_H_

#include <memory>

#include "obscura/hemisphere.h"
#include "screen/hemisphere/kernel.h"
#include "screen/method.h"

namespace obscura {

// See obscura/hemisphere.h. `width` x `height` is the largest image to come.
Status make_hemisphere(const HemisphereSettings& settings, int width, int height,
                       std::unique_ptr<Method>* method);

// Checks the settings and prepares what does not change from frame to frame.
Status make_hemisphere_frame(const HemisphereSettings& settings, hemisphere::Frame* frame);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_HEMISPHERE_PLAN_H_
