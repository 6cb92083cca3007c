#include "core/reflection_noise.h"
#include "core/volumetric.h"
#include "screen/point/point.h"
#include "screen/point/point_kernel.h"
#include "shaders/point.h"
#include "vulkan/volumetric.h"

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

}  // namespace

Status make_program(const PointSettings& settings, const FrameShape& shape, Program* program) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  if (Status s = validate(settings.dual); !s.ok()) return s;
  if (settings.pattern != PointPattern::kBall) {
    return unsupported("on Vulkan, point works with pattern ball so far");
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
