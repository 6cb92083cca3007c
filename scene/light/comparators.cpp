#include "scene/light/comparators.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura::tools {
namespace {

using Triple = std::array<float, 3>;

Triple to_world(const std::array<float, 9>& m, const Triple& w) {
  Triple d;
  for (int k = 0; k < 3; ++k) d[k] = m[3 * k] * w[0] + m[3 * k + 1] * w[1] + m[3 * k + 2] * w[2];
  return d;
}

// Adds the sun to `light` where direction d is within `cosine` of it, spread over that cone.
void add_sun(const Sun& sun, const Triple& d, double cosine, Triple* light) {
  const double toward = d[0] * sun.direction[0] + d[1] * sun.direction[1] + d[2] * sun.direction[2];
  if (!sun.shines() || toward <= cosine) return;
  const double spread = std::numbers::pi * (1 - cosine * cosine);
  for (int k = 0; k < 3; ++k) {
    (*light)[k] += static_cast<float>(sun.irradiance[k] / std::max(spread, 1e-12));
  }
}

}  // namespace

RadianceByDirection light_of_rays(const Environment& environment,
                                  const std::array<float, 9>& world_from_eye) {
  const double edge = std::cos(environment.sun().angular_radius);
  return [environment, world_from_eye, edge](const Triple& w) {
    const Triple d = to_world(world_from_eye, w);
    Triple light = environment.radiance(d);
    add_sun(environment.sun(), d, edge, &light);
    return light;
  };
}

RadianceByDirection light_of_samples(const PreconvolvedEnvironment& convolved, int samples,
                                     const std::array<float, 9>& world_from_eye) {
  const double cosine = 1 - 1.0 / samples;
  return [convolved, world_from_eye, cosine](const Triple& w) {
    const Triple d = to_world(world_from_eye, w);
    Triple light = convolved.radiance(d, static_cast<float>(std::acos(cosine)));
    add_sun(convolved.sun(), d, cosine, &light);
    return light;
  };
}

}  // namespace obscura::tools
