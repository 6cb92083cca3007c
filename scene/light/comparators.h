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

// Of a ray: the environment, and the sun where the ray meets its disc. With the reference tracer
// this is the truth.
RadianceByDirection light_of_rays(const Environment& environment,
                                  const std::array<float, 9>& world_from_eye);

// Of one of `samples` directions over the hemisphere: what a cone of as much of it shows, the sun
// spread over the cone. With `hemisphere` this is directional occlusion (SSDO; Ritschel, Grosch,
// Seidel 2009).
RadianceByDirection light_of_samples(const PreconvolvedEnvironment& convolved, int samples,
                                     const std::array<float, 9>& world_from_eye);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_LIGHT_COMPARATORS_H_
