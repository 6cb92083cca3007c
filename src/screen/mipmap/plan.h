#ifndef OBSCURA_SRC_SCREEN_MIPMAP_PLAN_H_
#define OBSCURA_SRC_SCREEN_MIPMAP_PLAN_H_

#include <vector>

#include "math/falloff.h"
#include "obscura/mipmap.h"
#include "screen/mipmap/kernel.h"

namespace obscura {

// Ambient obscurance from a depth pyramid; settings and paper: obscura/mipmap.h.
struct MipmapPlan {
  math::Rho rho;
  std::vector<MipmapDirection> directions;
};

// Checks the settings and prepares what does not change from frame to frame, on any device.
Status make_plan(const MipmapSettings& settings, MipmapPlan* plan);

// What depends on the image's size: the samples along every direction, and the levels of the
// pyramid down to a texel a side.
std::vector<MipmapStep> mipmap_steps(const MipmapSettings& settings, int width, int height);
int mipmap_level_count(int width, int height);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_MIPMAP_PLAN_H_
