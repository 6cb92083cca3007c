#include "screen/volumetric/gpu.h"

#include "core/reflection_noise.h"
#include "filters/interleaved/gpu.h"
#include "screen/gpu.h"
#include "screen/volumetric/point/plan.h"
#include "screen/volumetric/point/screen_pattern.h"
#include "shaders/point.h"
#include "shaders/screen_pattern.h"
#include "view/gpu.h"

namespace obscura::gpu {
namespace {

void add_ball(const PointSettings& settings, const PointFrame& f, const Frame& frame,
              const Geometry& g, const VisibilityTarget& target, Program* program) {
  namespace io = point_io;
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.z, f.weight}) pattern.push_back(column[i]);
  }
  add_sampling({.name = "point",
                .shader = shaders::point,
                .radius = f.view.radius,
                .thickness = f.thickness,
                .push = push_words(io::Push{.pattern = program->add_table(pattern)})},
               {.samples = f.samples, .rotate = settings.rotate, .thickness = f.thickness > 0},
               frame, g, target, program);
}

void add_screen(const PointSettings& settings, const Frame& frame, const Geometry& g,
                const ScreenPatternFrame& f, const SumRegions& sums, const VisibilityTarget& target,
                Program* program) {
  namespace io = screen_pattern_io;
  const bool normals = g.normals >= 0;
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.weight}) pattern.push_back(column[i]);
  }
  const int start = program->add_table(pattern);
  program->add({.name = "sample",
                .shader = shaders::screen_pattern,
                .constants = {{io::kSamples, f.samples},
                              {io::kNormals, normals},
                              {io::kRotate, settings.rotate},
                              {io::kQuadratic, f.quadratic},
                              {io::kDirections, frame.directions()},
                              {io::kNoise, ReflectionNoise::kSize}},
                .slots = {{io::kDepthAt, g.depth},
                          {io::kNormalsAt, normals ? g.normals : g.depth},
                          {io::kTablesAt, program->table_region},
                          {io::kOpenAt, sums.any()},
                          {io::kDirectionsAt, sums.any()}},
                .size = frame.visible(),
                .radius = f.view.radius,
                .push = push_words(io::Push{.pattern = start, .angle_grain = kAngleGrain})});
  add_denoising(frame, g, sums,
                {.interleave = settings.blur ? kScreenPatternInterleave : 1, .edge = f.view.radius},
                target, program);
}

// The screen pattern blurs by itself: each radius is blurred before they are combined.
Status make_screen_program(const PointSettings& settings, const Spheres<ScreenPatternFrame>& plan,
                           const Frame& frame, Program* program) {
  const Demands demands{.method = "point", .normals = frame.directions(), .directions = true};
  if (Status s = check(demands, frame.shape); !s.ok()) return s;
  if (frame.directions() && plan.second) {
    return unsupported("two radii give no directions");
  }
  const Geometry g = add_geometry(frame, frame.shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  const VolumetricTargets targets(frame, settings.dual, false, program);
  const SumRegions sums = add_sums(frame, !frame.directions(), frame.directions(), program);
  add_screen(settings, frame, g, plan.first, sums, targets.first(), program);
  if (plan.second) add_screen(settings, frame, g, *plan.second, sums, targets.second(), program);
  return {};
}

}  // namespace

template <>
Status make_program(const PointSettings& settings, const Frame& frame, Program* program) {
  PointPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (settings.pattern == PointPattern::kScreen) {
    return make_screen_program(settings, plan.screen, frame, program);
  }
  if (Status s = check({.method = "point with pattern ball"}, frame.shape); !s.ok()) return s;
  const Geometry g = add_geometry(frame, frame.shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, true, program);
  add_volumetric(
      settings, plan.ball, frame, g,
      [&](const PointFrame& f, const VisibilityTarget& target) {
        add_ball(settings, f, frame, g, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::gpu
