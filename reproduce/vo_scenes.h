#ifndef OBSCURA_REPRODUCE_VO_SCENES_H_
#define OBSCURA_REPRODUCE_VO_SCENES_H_

#include <string>
#include <vector>

#include "io/images/depth_input.h"
#include "obscura/obscura.h"

namespace obscura::tools {

// A variant of volumetric obscurance under test.
struct VoVariant {
  std::string name;
  MethodSettings settings;
};

// 5 and 9 lines, 12 and 33 points, 1 and 9 areas of one radius, reflected at random, not blurred.
std::vector<VoVariant> vo_variants(float radius);

// Horizon-based ambient occlusion of the same radius, and the integral that it converges to.
VoVariant vo_horizon(float radius);
Status vo_converged_horizon(const DepthInput& input, float radius, Executor* executor,
                            std::vector<float>* visibility);

// The same settings with the edge-aware blur.
MethodSettings vo_blurred(MethodSettings settings);

// Visibility of one frame; `seed` replaces the settings' own.
Status vo_visibility(const DepthInput& input, MethodSettings settings, std::uint32_t seed,
                     Executor* executor, std::vector<float>* visibility);

// The integral that lines and points both estimate: the mean of many reflections of 32 lines.
Status vo_converged(const DepthInput& input, float radius, int patterns, Executor* executor,
                    std::vector<float>* visibility);

// Mean absolute difference in per cent over pixels with a surface.
double vo_error(const DepthInput& input, const std::vector<float>& a, const std::vector<float>& b);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_VO_SCENES_H_
