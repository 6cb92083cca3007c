#include <bit>

#include "core/reflection_noise.h"
#include "filters/interleaved/gpu.h"
#include "screen/volumetric/point/plan.h"
#include "screen/volumetric/point/screen_pattern.h"
#include "shaders/point.h"
#include "shaders/screen_pattern.h"

namespace obscura::vulkan {
namespace {

void add_ball(const PointSettings& settings, const PointFrame& f, const FrameShape& shape,
              const Geometry& g, const VisibilityTarget& target, Program* program) {
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.z, f.weight}) pattern.push_back(column[i]);
  }
  add_sampling(
      {.name = "point", .spirv = shaders::point, .radius = f.view.radius, .thickness = f.thickness},
      {{static_cast<std::uint32_t>(f.samples), g.normals >= 0, settings.rotate, f.thickness > 0,
        ReflectionNoise::kSize}},
      shape, g, target, pattern, program);
}

void add_screen(const PointSettings& settings, const FrameShape& shape, const Geometry& g,
                const ScreenPatternFrame& f, const SumRegions& sums, const VisibilityTarget& target,
                Program* program) {
  const bool normals = g.normals >= 0, directions = shape.directions != Directions::kNone;
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.weight}) pattern.push_back(column[i]);
  }
  const std::uint32_t start = program->add_table(pattern);
  const Slot sum = Slot::of(directions ? sums.directions : sums.open);
  program->passes.push_back(
      {.name = "sample",
       .spirv = shaders::screen_pattern,
       .constants = {static_cast<std::uint32_t>(f.samples), normals, settings.rotate, f.quadratic,
                     directions, ReflectionNoise::kSize},
       .slots = {Slot::of(g.depth), Slot::of(normals ? g.normals : g.depth),
                 Slot::of(program->table_region), sum, sum},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .radius = f.view.radius,
       .push = {start, std::bit_cast<std::uint32_t>(kAngleGrain)}});
  add_resolution(shape, g, sums,
                 {.interleave = settings.blur ? kScreenPatternInterleave : 1,
                  .edge = f.view.radius,
                  .target = &target},
                 program);
}

// The screen pattern blurs by itself: each radius is blurred before they are combined.
Status make_screen_program(const PointSettings& settings, const Spheres<ScreenPatternFrame>& plan,
                           const FrameShape& shape, Program* program) {
  const bool directions = shape.directions != Directions::kNone;
  if (directions) {
    if (settings.dual.second_radius) return unsupported("two radii give no directions");
    if (shape.normal_use == NormalUse::kNone) {
      return unsupported("bent normals need normals; normal_use is none");
    }
  }
  const Geometry g = add_geometry(shape, shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  const VolumetricTargets targets(shape, settings.dual, false, program);
  const SumRegions sums = add_sums(shape, !directions, directions, program);
  add_screen(settings, shape, g, plan.first, sums, targets.first(), program);
  if (plan.second) add_screen(settings, shape, g, *plan.second, sums, targets.second(), program);
  return {};
}

}  // namespace

template <>
Status make_program(const PointSettings& settings, const FrameShape& shape, Program* program) {
  PointPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (settings.pattern == PointPattern::kScreen) {
    return make_screen_program(settings, plan.screen, shape, program);
  }
  if (shape.directions != Directions::kNone) {
    return unsupported("point gives no directions with pattern ball");
  }
  const Geometry g = add_geometry(shape, shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, true, program);
  add_volumetric(
      settings, plan.ball, shape, g,
      [&](const PointFrame& f, const VisibilityTarget& target) {
        add_ball(settings, f, shape, g, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::vulkan
