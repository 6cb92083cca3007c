#ifndef OBSCURA_SCENE_TRUTH_FILL_BETWEEN_H_
#define OBSCURA_SCENE_TRUTH_FILL_BETWEEN_H_

#include "io/images/depth_input.h"
#include "obscura/executor.h"
#include "obscura/outputs.h"

namespace obscura::tools {

// Interpolates the visible pixels between the traced ones, which have x % every == y % every ==
// every / 2. Each pixel takes the four traced pixels around it, with bilinear weights that are
// lower for pixels off its tangent plane and for other normals. If none of the four has a surface,
// the pixel stays NaN.
void fill_between(const DepthInput& gbuffer, int every, const Outputs& outputs, Executor& executor);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_FILL_BETWEEN_H_
