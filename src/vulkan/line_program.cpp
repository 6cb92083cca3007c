#include "core/reflection_noise.h"
#include "core/volumetric.h"
#include "screen/line/line.h"
#include "screen/line/line_kernel.h"
#include "shaders/line.h"
#include "vulkan/program.h"

namespace obscura::vulkan {

Status make_program(const LineSettings& settings, const FrameShape& shape, Program* program) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  if (settings.blur || settings.dual.second_radius) {
    return unsupported("on Vulkan, line works without blur and second radius so far");
  }
  if (shape.directions != Directions::kNone) return unsupported("line gives no directions");
  const bool normals = shape.normal_use != NormalUse::kNone;
  const LineFrame f = line_frame(settings, disk_pattern(settings.samples, settings.center));
  if (f.tangent && !normals) {
    return invalid_argument("sphere is tangent, which needs normals, but normals are off");
  }
  const Geometry g = add_geometry(shape, normals, program);
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.lateral, f.extent, f.half, f.weight}) {
      program->tables.push_back(column[i]);
    }
  }
  if (settings.rotate) {
    const ReflectionNoise noise(settings.seed);
    for (int i = 0; i < ReflectionNoise::kSize * ReflectionNoise::kSize; ++i) {
      program->tables.push_back(noise.x()[i]);
      program->tables.push_back(noise.y()[i]);
    }
  }
  program->table_region = program->add_region(program->tables.size() * sizeof(float));
  program->passes.push_back(
      {.name = "line",
       .spirv = shaders::line,
       .constants = {static_cast<std::uint32_t>(f.samples), normals, settings.rotate,
                     f.thickness > 0, f.quadratic, f.tangent, ReflectionNoise::kSize},
       .slots = {Slot::of(g.depth), Slot::of(normals ? g.normals : g.depth),
                 Slot::of(program->table_region), Slot::image(Slot::kVisibilityImage)},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .radius = f.view.radius,
       .thickness = f.thickness});
  return {};
}

}  // namespace obscura::vulkan
