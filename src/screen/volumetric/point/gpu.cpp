#include <bit>

#include "core/reflection_noise.h"
#include "filters/interleaved/gpu.h"
#include "screen/volumetric/point/kernel.h"
#include "screen/volumetric/point/plan.h"
#include "screen/volumetric/point/screen_pattern.h"
#include "screen/volumetric/point/screen_pattern_kernel.h"
#include "screen/volumetric/volumetric.h"
#include "shaders/point.h"
#include "shaders/screen_pattern.h"

namespace obscura::vulkan {
namespace {

void add_ball(const PointSettings& settings, const FrameShape& shape, const Geometry& g,
              const VisibilityTarget& target, Program* program) {
  const PointFrame f = point_frame(settings, ball_pattern(settings.samples));
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
Status make_screen_program(const PointSettings& settings, const FrameShape& shape,
                           Program* program) {
  ScreenPatternFrame f;
  if (Status s = make_screen_pattern_frame(settings, &f); !s.ok()) return s;
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
  add_screen(settings, shape, g, f, sums, targets.first(), program);
  if (!settings.dual.second_radius) return {};
  f.view.radius = view::tap_radius(*settings.dual.second_radius);
  add_screen(settings, shape, g, f, sums, targets.second(), program);
  return {};
}

}  // namespace

Status make_program(const PointSettings& settings, const FrameShape& shape, Program* program) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  if (Status s = validate(settings.dual); !s.ok()) return s;
  if (settings.pattern == PointPattern::kScreen) {
    return make_screen_program(settings, shape, program);
  }
  if (shape.directions != Directions::kNone) {
    return unsupported("point gives no directions with pattern ball");
  }
  const Geometry g = add_geometry(shape, shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, true, program);
  add_volumetric(
      settings, shape, g,
      [&](const PointSettings& s, const VisibilityTarget& target) {
        add_ball(s, shape, g, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::vulkan
