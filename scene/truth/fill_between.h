#ifndef OBSCURA_SCENE_TRUTH_FILL_BETWEEN_H_
#define OBSCURA_SCENE_TRUTH_FILL_BETWEEN_H_

#include "io/images/depth_input.h"
#include "obscura/executor.h"
#include "obscura/outputs.h"

namespace obscura::tools {

// Fills the visible pixels between those with x % every == y % every == every / 2, from the four
// of these around each: bilinear weights, lowered for those off the pixel's tangent plane and for
// those whose normal differs. Where none of the four has a surface the pixel stays NaN.
void fill_between(const DepthInput& gbuffer, int every, const Outputs& outputs, Executor& executor);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_FILL_BETWEEN_H_
