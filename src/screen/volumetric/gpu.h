#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_GPU_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_GPU_H_

#include <span>

#include "filters/bilateral/gpu.h"
#include "gpu/program.h"
#include "gpu/visibility_target.h"
#include "obscura/dual_radius.h"
#include "screen/volumetric/volumetric.h"

namespace obscura::gpu {

// The pattern's reflections: the start of the tables, if there are any.
void add_reflections(bool rotate, std::uint32_t seed, bool space, Program* program);

// What the passes of one or two radii and the blur hand on.
class VolumetricTargets {
 public:
  VolumetricTargets(const Frame& frame, const DualRadius& dual, bool blur, Program* program);

  VisibilityTarget first() const { return {result_, region_, !dual_ && !blur_}; }
  // Combines its own result with the first's.
  VisibilityTarget second() const { return {result_, region_, !blur_, combine_}; }
  int region() const { return region_; }

 private:
  Slot result_;
  bool dual_, blur_;
  CombineWith combine_;
  int region_;
};

// What the pattern of one radius is to its pass (OBSCURA_SAMPLING).
struct Sampling {
  int samples;
  bool rotate, thickness;
};

// Adds constants and slots of OBSCURA_SAMPLING and of the target to a pass, which is given with
// what only its shader has.
void add_sampling(Pass pass, const Sampling& sampling, const Frame& frame, const Geometry& g,
                  const VisibilityTarget& target, Program* program);

// The passes of a method of volumetric obscurance with what may be around it: a second sphere and
// the blur. sample(frame of the plan, target) adds the passes of one sphere.
template <class Settings, class SphereFrame, class Sample>
void add_volumetric(const Settings& s, const Spheres<SphereFrame>& plan, const Frame& frame,
                    const Geometry& g, Sample sample, Program* program) {
  const VolumetricTargets targets(frame, s.dual, s.blur, program);
  sample(plan.first, targets.first());
  if (plan.second) sample(*plan.second, targets.second());
  if (s.blur) add_blur(frame, g, targets.region(), s.falloff.radius, program);
}

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_GPU_H_
