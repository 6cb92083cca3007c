#include <bit>

#include "core/reflection_noise.h"
#include "gpu/volumetric.h"
#include "screen/volumetric/area/plan.h"
#include "shaders/area.h"
#include "shaders/moments.h"

namespace obscura::vulkan {
namespace {

constexpr int kTile = 16;               // of moments.comp
constexpr std::size_t kTexelBytes = 8;  // of moments.glsl

// The pyramid in scratch memory: level l from 1 on, at the texels of level l - 1.
struct Pyramid {
  int levels = 0;
  int region = -1;
  std::uint32_t table = 0;  // per level where it starts and its kernel's deviation
};

Pass level_pass(const FrameShape& shape, const Geometry& g, const Pyramid& pyramid, int level,
                std::uint32_t from, std::uint32_t to) {
  const int grid = level - 1, from_grid = std::max(grid - 1, 0);
  const int shift = MomentPyramid::shift(grid);
  const int width = MomentPyramid::level_size(shape.width, grid);
  const int height = MomentPyramid::level_size(shape.height, grid);
  const int from_width = MomentPyramid::level_size(shape.width, from_grid);
  const std::uint32_t keep = shift > MomentPyramid::shift(from_grid) ? 2 : 1;
  const VkDeviceSize texels = static_cast<VkDeviceSize>(width) * height;
  return {.name = "moments",
          .spirv = shaders::moments,
          .constants = {level == 1},
          .slots = {Slot::of(g.depth), Slot::of(pyramid.region)},
          .width = width,
          .height = height,
          .group_x = kTile,
          .group_y = kTile,
          .push = {from, static_cast<std::uint32_t>(from_width), keep, to,
                   static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                   1u << (grid - shift)},
          .bytes = texels * (kTexelBytes + (level == 1 ? sizeof(float) : kTexelBytes))};
}

Pyramid add_pyramid(const FrameShape& shape, const Geometry& g, Program* program) {
  Pyramid pyramid;
  pyramid.levels = MomentPyramid::level_count(shape.width, shape.height);
  pyramid.region = program->add_region(0);
  std::vector<float> table = {0, 0};  // level 0 is the depth image
  std::uint32_t from = 0, texels = 0;
  for (int l = 1; l < pyramid.levels; ++l) {
    const std::uint32_t to = texels;
    program->passes.push_back(level_pass(shape, g, pyramid, l, from, to));
    table.push_back(std::bit_cast<float>(to));
    table.push_back(static_cast<float>(MomentPyramid::kernel_width(l)));
    texels += static_cast<std::uint32_t>(MomentPyramid::level_size(shape.width, l - 1)) *
              MomentPyramid::level_size(shape.height, l - 1);
    from = to;
  }
  // The last level's kernel has a next one, which does not count.
  table.insert(table.end(), {0, 0});
  program->regions[pyramid.region] = kTexelBytes * std::max(texels, 1u);
  pyramid.table = program->add_table(table);
  return pyramid;
}

void add_area(const AreaSettings& settings, const AreaFrame& f, const FrameShape& shape,
              const Geometry& g, const Pyramid& pyramid, const VisibilityTarget& target,
              Program* program) {
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.lateral, f.extent, f.half, f.weight, f.level}) {
      pattern.push_back(column[i]);
    }
  }
  add_sampling({.name = "area",
                .spirv = shaders::area,
                .slots = {Slot::of(pyramid.region)},
                .radius = f.view.radius,
                .thickness = f.thickness,
                .push = {pyramid.table, static_cast<std::uint32_t>(pyramid.levels)}},
               {{static_cast<std::uint32_t>(f.samples), g.normals >= 0, settings.rotate,
                 f.thickness > 0, f.quadratic, ReflectionNoise::kSize, MomentPyramid::kFullLevels}},
               shape, g, target, pattern, program);
}

}  // namespace

template <>
Status make_program(const AreaSettings& settings, const FrameShape& shape, Program* program) {
  AreaPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (shape.directions != Directions::kNone) return unsupported("area gives no directions");
  const Geometry g = add_geometry(shape, shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  const Pyramid pyramid = add_pyramid(shape, g, program);
  add_volumetric(
      settings, plan, shape, g,
      [&](const AreaFrame& f, const VisibilityTarget& target) {
        add_area(settings, f, shape, g, pyramid, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::vulkan
