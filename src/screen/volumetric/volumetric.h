#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_H_

#include <memory>
#include <optional>

#include "core/check_sphere.h"
#include "screen/volumetric/blurred.h"
#include "screen/volumetric/dual.h"

namespace obscura {

// Every setting that point, line and area sampling share, for any device.
template <class Settings>
Status check_volumetric(const Settings& settings) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_sphere(settings.falloff, settings.occluder, "volumetric obscurance");
      !s.ok()) {
    return s;
  }
  return validate(settings.dual);
}

// What does not change from frame to frame, for the sphere and for the second one if there is one.
template <class Frame>
struct Spheres {
  Frame first;
  std::optional<Frame> second{};
};

// frame(settings) prepares the sphere of one radius.
template <class Settings, class MakeFrame>
auto plan_spheres(const Settings& settings, MakeFrame frame) {
  Spheres<decltype(frame(settings))> plan{.first = frame(settings)};
  if (settings.dual.second_radius) {
    Settings other = settings;
    other.falloff.radius = *settings.dual.second_radius;
    plan.second = frame(other);
  }
  return plan;
}

// On the CPU: the method of one sphere or of both, with the blur if `blur` says so.
// make(frame) gives the method of one sphere; `width` x `height` is the whole depth image.
template <class Settings, class Frame, class Make>
std::unique_ptr<Method> make_spheres(const Settings& settings, const Spheres<Frame>& plan,
                                     bool blur, int width, int height, Make make) {
  std::unique_ptr<Method> method = make(plan.first);
  if (plan.second) {
    method = make_dual(std::move(method), make(*plan.second), settings.dual.combine, width, height);
  }
  if (blur) method = make_blurred(std::move(method), settings.falloff.radius, width, height);
  return method;
}

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_H_
