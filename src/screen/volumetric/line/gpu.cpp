#include "core/reflection_noise.h"
#include "gpu/volumetric.h"
#include "screen/volumetric/line/plan.h"
#include "shaders/line.h"

namespace obscura::vulkan {
namespace {

void add_line(const LineSettings& settings, const LineFrame& f, const FrameShape& shape,
              const Geometry& g, const VisibilityTarget& target, Program* program) {
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.lateral, f.extent, f.half, f.weight}) {
      pattern.push_back(column[i]);
    }
  }
  add_sampling(
      {.name = "line", .spirv = shaders::line, .radius = f.view.radius, .thickness = f.thickness},
      {{static_cast<std::uint32_t>(f.samples), g.normals >= 0, settings.rotate, f.thickness > 0,
        f.quadratic, f.tangent, ReflectionNoise::kSize}},
      shape, g, target, pattern, program);
}

}  // namespace

template <>
Status make_program(const LineSettings& settings, const FrameShape& shape, Program* program) {
  LinePlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (shape.directions != Directions::kNone) return unsupported("line gives no directions");
  const bool normals = shape.normal_use != NormalUse::kNone;
  if (settings.sphere == SphereKind::kTangent && !normals) {
    return invalid_argument("sphere is tangent, which needs normals, but normals are off");
  }
  const Geometry g = add_geometry(shape, normals, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  add_volumetric(
      settings, plan, shape, g,
      [&](const LineFrame& f, const VisibilityTarget& target) {
        add_line(settings, f, shape, g, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::vulkan
