#include "core/reflection_noise.h"
#include "core/volumetric.h"
#include "screen/line/line.h"
#include "screen/line/line_kernel.h"
#include "shaders/line.h"
#include "vulkan/volumetric.h"

namespace obscura::vulkan {
namespace {

void add_line(const LineSettings& settings, const FrameShape& shape, const Geometry& g,
              const VisibilityTarget& target, Program* program) {
  const LineFrame f = line_frame(settings, disk_pattern(settings.samples, settings.center));
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.lateral, f.extent, f.half, f.weight}) {
      pattern.push_back(column[i]);
    }
  }
  const bool normals = g.normals >= 0;
  Pass pass{.name = "line",
            .spirv = shaders::line,
            .constants = target.constants,
            .slots = target.slots,
            .width = visible_width(shape),
            .height = visible_height(shape),
            .radius = f.view.radius,
            .thickness = f.thickness,
            .push = {program->add_table(pattern)}};
  for (std::uint32_t constant :
       {static_cast<std::uint32_t>(f.samples), std::uint32_t{normals},
        std::uint32_t{settings.rotate}, std::uint32_t{f.thickness > 0}, std::uint32_t{f.quadratic},
        std::uint32_t{f.tangent}, std::uint32_t{ReflectionNoise::kSize}}) {
    pass.constants.push_back(constant);
  }
  for (int region : {g.depth, normals ? g.normals : g.depth, program->table_region}) {
    pass.slots.push_back(Slot::of(region));
  }
  program->passes.push_back(std::move(pass));
}

}  // namespace

Status make_program(const LineSettings& settings, const FrameShape& shape, Program* program) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  if (Status s = validate(settings.dual); !s.ok()) return s;
  if (shape.directions != Directions::kNone) return unsupported("line gives no directions");
  const bool normals = shape.normal_use != NormalUse::kNone;
  if (settings.sphere == SphereKind::kTangent && !normals) {
    return invalid_argument("sphere is tangent, which needs normals, but normals are off");
  }
  const Geometry g = add_geometry(shape, normals, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  add_volumetric(
      settings, shape, g,
      [&](const LineSettings& s, const VisibilityTarget& target) {
        add_line(s, shape, g, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::vulkan
