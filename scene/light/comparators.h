#ifndef OBSCURA_SCENE_LIGHT_COMPARATORS_H_
#define OBSCURA_SCENE_LIGHT_COMPARATORS_H_

#include <array>
#include <functional>

#include "obscura/environment.h"
#include "obscura/lighting.h"

// Light along single directions, for estimators whose samples or rays carry it
// (HemisphereSettings::radiance, ReferenceSettings::radiance). `world_from_eye` is row-major.
namespace obscura::tools {

using RadianceByDirection = std::function<std::array<float, 3>(const std::array<float, 3>&)>;

// Light along a ray: the environment, and the sun if the ray meets its disc. With the reference
// tracer this is the ground truth.
RadianceByDirection light_of_rays(const Environment& environment,
                                  const std::array<float, 9>& world_from_eye);

// Light of one of `samples` directions over the hemisphere: the mean over a cone of that share of
// the hemisphere, with the sun spread over it. With `hemisphere` this is directional occlusion
// (SSDO; Ritschel, Grosch, Seidel 2009).
RadianceByDirection light_of_samples(const PreconvolvedEnvironment& convolved, int samples,
                                     const std::array<float, 9>& world_from_eye);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_LIGHT_COMPARATORS_H_
