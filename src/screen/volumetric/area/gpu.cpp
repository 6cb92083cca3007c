#include "screen/volumetric/gpu.h"

#include <algorithm>
#include <bit>

#include "screen/gpu.h"
#include "screen/volumetric/area/plan.h"
#include "shaders/area.h"
#include "shaders/moments.h"
#include "view/gpu.h"

namespace obscura::gpu {
namespace {

constexpr std::size_t kTexelBytes = 8;  // of moments.glsl

// The pyramid in scratch memory: level l from 1 on, at the texels of level l - 1.
struct Pyramid {
  int levels = 0;
  int region = -1;
  int table = 0;  // per level where it starts and its kernel's deviation
};

Extent grid_size(const FrameShape& shape, int grid) {
  return {MomentPyramid::level_size(shape.width, grid),
          MomentPyramid::level_size(shape.height, grid)};
}

Pass level_pass(const FrameShape& shape, const Geometry& g, const Pyramid& pyramid, int level,
                int from, int to, float slack) {
  namespace io = moments_io;
  const int grid = level - 1, from_grid = std::max(grid - 1, 0);
  const int shift = MomentPyramid::shift(grid);
  const Extent size = grid_size(shape, grid);
  return {.name = "moments",
          .shader = shaders::moments,
          .constants = {{io::kFirst, level == 1}},
          .slots = {{io::kDepthAt, g.depth}, {io::kMomentsAt, pyramid.region}},
          .size = size,
          .push = push_words(io::Push{.from = from,
                                      .from_width = grid_size(shape, from_grid).width,
                                      .keep = shift > MomentPyramid::shift(from_grid) ? 2 : 1,
                                      .to = to,
                                      .to_width = size.width,
                                      .to_height = size.height,
                                      .tap_step = 1 << (grid - shift),
                                      .slack = slack}),
          .bytes = size.pixels() * (kTexelBytes + (level == 1 ? sizeof(float) : kTexelBytes))};
}

Pyramid add_pyramid(const FrameShape& shape, const Geometry& g, float slack, Program* program) {
  Pyramid pyramid;
  pyramid.levels = MomentPyramid::level_count(shape.width, shape.height);
  pyramid.region = program->add_region(0);
  std::vector<float> table = {0, 0};  // level 0 is the depth image
  int from = 0, texels = 0;
  for (int l = 1; l < pyramid.levels; ++l) {
    const int to = texels;
    program->add(level_pass(shape, g, pyramid, l, from, to, slack));
    table.push_back(std::bit_cast<float>(to));
    table.push_back(static_cast<float>(MomentPyramid::kernel_width(l)));
    texels += static_cast<int>(grid_size(shape, l - 1).pixels());
    from = to;
  }
  // The last level's kernel has a next one, which does not count.
  table.insert(table.end(), {0, 0});
  program->regions[pyramid.region] = kTexelBytes * static_cast<std::uint64_t>(std::max(texels, 1));
  pyramid.table = program->add_table(table);
  return pyramid;
}

void add_area(const AreaSettings& settings, const AreaFrame& f, const Frame& frame,
              const Geometry& g, const Pyramid& pyramid, const VisibilityTarget& target,
              Program* program) {
  namespace io = area_io;
  std::vector<float> pattern;
  for (int i = 0; i < f.samples; ++i) {
    for (const float* column : {f.x, f.y, f.lateral, f.extent, f.half, f.weight, f.level}) {
      pattern.push_back(column[i]);
    }
  }
  add_sampling(
      {.name = "area",
       .shader = shaders::area,
       .constants = {{io::kQuadratic, f.quadratic}, {io::kFullLevels, MomentPyramid::kFullLevels}},
       .slots = {{io::kMomentsAt, pyramid.region}},
       .radius = f.view.radius,
       .thickness = f.thickness,
       .push = push_words(io::Push{.pattern = program->add_table(pattern),
                                   .levels = pyramid.table,
                                   .level_count = pyramid.levels,
                                   .slack = area_slack(settings)})},
      {.samples = f.samples, .rotate = settings.rotate, .thickness = f.thickness > 0}, frame, g,
      target, program);
}

}  // namespace

template <>
Status make_program(const AreaSettings& settings, const Frame& frame, Program* program) {
  AreaPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (Status s = check({.method = "area"}, frame.shape); !s.ok()) return s;
  const Geometry g = add_geometry(frame, frame.shape.normal_use != NormalUse::kNone, program);
  add_reflections(settings.rotate, settings.seed, false, program);
  const Pyramid pyramid = add_pyramid(frame.shape, g, area_slack(settings), program);
  add_volumetric(
      settings, plan, frame, g,
      [&](const AreaFrame& f, const VisibilityTarget& target) {
        add_area(settings, f, frame, g, pyramid, target, program);
      },
      program);
  return {};
}

}  // namespace obscura::gpu
