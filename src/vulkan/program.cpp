#include "vulkan/program.h"

#include "core/reflection_noise.h"
#include "core/volumetric.h"
#include "screen/line/line.h"
#include "screen/line/line_kernel.h"
#include "shaders/depth.h"
#include "shaders/line.h"
#include "shaders/normals.h"

namespace obscura::vulkan {
namespace {

int visible_width(const FrameShape& s) { return s.width - s.guard_band.left - s.guard_band.right; }
int visible_height(const FrameShape& s) {
  return s.height - s.guard_band.top - s.guard_band.bottom;
}

}  // namespace

Geometry add_geometry(const FrameShape& shape, bool normals, Program* program) {
  const auto pixels = static_cast<VkDeviceSize>(shape.width) * shape.height;
  const auto visible = static_cast<VkDeviceSize>(visible_width(shape)) * visible_height(shape);
  Geometry g;
  g.depth = program->add_region(pixels * sizeof(float));
  program->passes.push_back({.name = "depth",
                             .spirv = shaders::depth,
                             .constants = {static_cast<std::uint32_t>(shape.depth_kind)},
                             .slots = {Slot::image(Slot::kDepthImage), Slot::of(g.depth)},
                             .width = shape.width,
                             .height = shape.height});
  if (!normals) return g;
  g.normals = program->add_region(visible * 4 * sizeof(float));
  // A binding wants an image even where the pass is specialised not to read it.
  const Slot given = Slot::image(shape.normals ? Slot::kNormalImage : Slot::kDepthImage);
  program->passes.push_back({.name = "normals",
                             .spirv = shaders::normals,
                             .constants = {shape.normals ? 1u : 0u},
                             .slots = {Slot::of(g.depth), Slot::of(g.normals), given},
                             .width = visible_width(shape),
                             .height = visible_height(shape)});
  return g;
}

Status make_program(const LineSettings& settings, const FrameShape& shape, Program* program) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  if (settings.blur || settings.dual.second_radius) {
    return unsupported("on Vulkan, line works without blur and second radius so far");
  }
  const bool normals = shape.normal_use != NormalUse::kNone;
  const LineFrame f = line_frame(settings, disk_pattern(settings.samples, settings.center));
  if (f.tangent && !normals) {
    return invalid_argument("sphere is tangent, which needs normals, but normals are off");
  }
  program->radius = f.view.radius;
  program->thickness = f.thickness;
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
       .height = visible_height(shape)});
  return {};
}

}  // namespace obscura::vulkan
