#include <algorithm>

#include "gpu/program.h"
#include "gpu/quads.h"
#include "screen/mipmap/plan.h"
#include "shaders/mipmap.h"
#include "shaders/mipmap_pyramid.h"

namespace obscura::vulkan {
namespace {

constexpr int kTile = 32, kLevelsPerPass = 5;  // of mipmap_pyramid.comp

struct Tables {
  Quads quads;
  int levels = 0, directions = 0, steps = 0, rho = 0;
  int level_count = 0, step_count = 0, texels = 0;  // of levels 1 and on
};

Tables make_tables(const MipmapSettings& settings, const MipmapPlan& plan,
                   const FrameShape& shape) {
  Tables t;
  t.rho = t.quads.add_floats(plan.rho.table);
  t.levels = t.quads.size();
  t.level_count = std::min(mipmap_level_count(shape.width, shape.height), kMaxMipmapLevels);
  int width = shape.width, height = shape.height;
  for (int level = 0; level < t.level_count; ++level) {
    t.quads.add(bits(t.texels), bits(width), bits(height), 0);
    if (level > 0) t.texels += width * height;
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
  t.directions = t.quads.size();
  for (const MipmapDirection& d : plan.directions) {
    t.quads.add(bits(d.u), bits(d.v), bits(d.low_u), bits(d.low_v));
    t.quads.add(bits(d.high_u), bits(d.high_v), 0, 0);
  }
  t.steps = t.quads.size();
  for (const MipmapStep& s : mipmap_steps(settings, shape.width, shape.height)) {
    t.quads.add(bits(s.distance), bits(s.level), bits(s.blend), 0);
    ++t.step_count;
  }
  return t;
}

void add_pyramid(const FrameShape& shape, const Tables& tables, bool mean, int depth, int pyramid,
                 Program* program) {
  for (int level = 0; level + 1 < tables.level_count; level += kLevelsPerPass) {
    program->passes.push_back(
        {.name = "pyramid",
         .spirv = shaders::mipmap_pyramid,
         .constants = {mean},
         .slots = {Slot::of(program->table_region), Slot::of(depth), Slot::of(pyramid)},
         .width = ((shape.width - 1) >> level) + 1,
         .height = ((shape.height - 1) >> level) + 1,
         .group_x = kTile,
         .group_y = kTile,
         .push = {bits(tables.levels), bits(level), bits(tables.level_count)}});
  }
}

}  // namespace

template <>
Status make_program(const MipmapSettings& settings, const FrameShape& shape, Program* program) {
  MipmapPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (shape.directions != Directions::kNone) return unsupported("mipmap gives no directions");
  if (shape.normal_use == NormalUse::kNone) {
    return unsupported("mipmap needs normals; normal_use is none");
  }
  const Geometry g = add_geometry(shape, true, program);
  const Tables t = make_tables(settings, plan, shape);
  program->tables = t.quads.words();
  program->table_region = program->add_region(program->tables.size() * sizeof(float));
  const int pyramid = program->add_region(std::max(t.texels, 1) * sizeof(float));
  const math::Rho& rho = plan.rho;
  const bool mean = settings.pyramid == DepthPyramid::kAverage;
  add_pyramid(shape, t, mean, g.depth, pyramid, program);
  program->passes.push_back(
      {.name = "evaluate",
       .spirv = shaders::mipmap,
       .constants = {static_cast<std::uint32_t>(rho.kind), bits(settings.directions), mean},
       .slots = {Slot::of(program->table_region), Slot::of(g.depth), Slot::of(pyramid),
                 Slot::of(g.normals), Slot::image(Slot::kVisibilityImage)},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .push = {bits(rho.radius), bits(rho.inverse_radius), bits(rho.entries_per_length),
                bits(rho.last_entry), bits(t.rho), bits(t.levels), bits(t.directions),
                bits(t.steps), bits(t.step_count), bits(t.level_count)}});
  return {};
}

}  // namespace obscura::vulkan
