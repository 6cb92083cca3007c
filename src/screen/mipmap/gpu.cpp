#include <algorithm>

#include "gpu/quads.h"
#include "screen/gpu.h"
#include "screen/mipmap/plan.h"
#include "shaders/mipmap.h"
#include "shaders/mipmap_pyramid.h"
#include "view/gpu.h"

namespace obscura::gpu {
namespace {

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
  namespace io = mipmap_pyramid_io;
  for (int level = 0; level + 1 < tables.level_count; level += io::kLevelsPerPass) {
    program->add({.name = "pyramid",
                  .shader = shaders::mipmap_pyramid,
                  .constants = {{io::kMean, mean}},
                  .slots = {{io::kTablesAt, program->table_region},
                            {io::kDepthAt, depth},
                            {io::kPyramidAt, pyramid}},
                  .size = {((shape.width - 1) >> level) + 1, ((shape.height - 1) >> level) + 1},
                  .push = push_words(io::Push{
                      .levels = tables.levels, .source = level, .count = tables.level_count})});
  }
}

}  // namespace

template <>
Status make_program(const MipmapSettings& settings, const Frame& frame, Program* program) {
  namespace io = mipmap_io;
  MipmapPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  const math::Rho& rho = plan.rho;
  if (Status s = check({.method = "mipmap", .normals = true}, frame.shape); !s.ok()) return s;
  const Geometry g = add_geometry(frame, true, program);
  const Tables t = make_tables(settings, plan, frame.shape);
  program->add_table(t.quads.words());
  const int pyramid = program->add_region(std::max(t.texels, 1) * sizeof(float));
  const bool mean = settings.pyramid == DepthPyramid::kAverage;
  add_pyramid(frame.shape, t, mean, g.depth, pyramid, program);
  program->add({.name = "evaluate",
                .shader = shaders::mipmap,
                .constants = {{io::kFalloff, static_cast<int>(rho.kind)},
                              {io::kDirections, settings.directions},
                              {io::kInterpolate, mean}},
                .slots = {{io::kTablesAt, program->table_region},
                          {io::kDepthAt, g.depth},
                          {io::kPyramidAt, pyramid},
                          {io::kNormalsAt, g.normals},
                          {io::kVisibilityResultAt, frame.results.visibility}},
                .size = frame.visible(),
                .push = push_words(io::Push{.rho_radius = rho.radius,
                                            .inverse_radius = rho.inverse_radius,
                                            .entries_per_length = rho.entries_per_length,
                                            .last_entry = rho.last_entry,
                                            .rho_start = t.rho,
                                            .levels = t.levels,
                                            .directions = t.directions,
                                            .steps = t.steps,
                                            .step_count = t.step_count,
                                            .level_count = t.level_count})});
  return {};
}

}  // namespace obscura::gpu
