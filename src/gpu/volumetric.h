#ifndef OBSCURA_SRC_GPU_VOLUMETRIC_H_
#define OBSCURA_SRC_GPU_VOLUMETRIC_H_

#include "gpu/program.h"
#include "obscura/dual_radius.h"

namespace obscura::vulkan {

// The pattern's reflections: the start of the tables, if there are any.
void add_reflections(bool rotate, std::uint32_t seed, bool space, Program* program);

// Where a pass of one radius leaves its visibility, as visibility.glsl has it: its first constants
// and slots.
struct VisibilityTarget {
  std::vector<std::uint32_t> constants;
  std::vector<Slot> slots;
};

// What the passes of one or two radii and the blur hand on.
class VolumetricTargets {
 public:
  VolumetricTargets(const FrameShape& shape, const DualRadius& dual, bool blur, Program* program);

  VisibilityTarget first() const { return target(!dual_ && !blur_, 0); }
  // Combines its own result with the first's.
  VisibilityTarget second() const { return target(!blur_, combine_ == Combine::kProduct ? 1 : 2); }
  int region() const { return region_; }

 private:
  VisibilityTarget target(bool to_image, std::uint32_t combine) const;

  bool dual_, blur_;
  Combine combine_;
  int region_;
};

// Adds the pass of one radius, which is given by its name, shader, radius, thickness and what only
// it has: `constants` come after the target's, its slots after the target's, depth, normals and
// tables, its push constants after where `pattern` starts in the tables.
void add_sampling(Pass pass, std::span<const std::uint32_t> constants, const FrameShape& shape,
                  const Geometry& g, const VisibilityTarget& target, std::span<const float> pattern,
                  Program* program);

// The edge-aware blur (filters/bilateral.h) from a region to the frame's visibility.
void add_blur(const FrameShape& shape, const Geometry& g, int region, float edge, Program* program);

// The passes of a method of volumetric obscurance with what may be around it: a second sphere and
// the blur. sample(frame, target) adds the passes of one sphere of the plan.
template <class Settings, class Plan, class Sample>
void add_volumetric(const Settings& s, const Plan& plan, const FrameShape& shape, const Geometry& g,
                    Sample sample, Program* program) {
  const VolumetricTargets targets(shape, s.dual, s.blur, program);
  sample(plan.first, targets.first());
  if (plan.second) sample(*plan.second, targets.second());
  if (s.blur) add_blur(shape, g, targets.region(), s.falloff.radius, program);
}

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_GPU_VOLUMETRIC_H_
