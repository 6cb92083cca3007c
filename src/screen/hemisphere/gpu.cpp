#include "filters/interleaved/gpu.h"
#include "screen/hemisphere/plan.h"
#include "shaders/hemisphere.h"

namespace obscura::vulkan {
namespace {

std::vector<float> tables_of(const hemisphere::Frame& f) {
  std::vector<float> tables;
  for (int i = 0; i < f.samples; ++i) {
    for (float value : {f.cosine[i], f.sine[i], f.offset[i]}) tables.push_back(value);
  }
  for (int y = 0; y < f.interleave; ++y) {
    for (int x = 0; x < f.interleave; ++x) {
      for (const auto& plane : f.tile) tables.push_back(plane[y][x]);
    }
  }
  return tables;
}

}  // namespace

template <>
Status make_program(const HemisphereSettings& settings, const FrameShape& shape, Program* program) {
  hemisphere::Frame f;
  if (Status s = make_plan(settings, &f); !s.ok()) return s;
  if (shape.normal_use == NormalUse::kNone) {
    return unsupported("hemisphere needs normals; normal_use is none");
  }
  const bool directions = shape.directions != Directions::kNone;
  const bool cosine = settings.weighting == RayWeighting::kCosine;
  const Geometry g = add_geometry(shape, true, program);
  program->tables = tables_of(f);
  program->table_region = program->add_region(program->tables.size() * sizeof(float));
  // Directions have uniform weights; so has then the visibility that is summed with them.
  const SumRegions sums = add_sums(shape, cosine || !directions, directions, program);
  const int any = directions ? sums.directions : sums.open;
  program->passes.push_back(
      {.name = "sample",
       .spirv = shaders::hemisphere,
       .constants = {static_cast<std::uint32_t>(f.samples), static_cast<std::uint32_t>(f.tests),
                     static_cast<std::uint32_t>(f.interleave), f.quadratic, f.thickness > 0,
                     sums.open >= 0, cosine, directions},
       .slots = {Slot::of(g.depth), Slot::of(g.normals), Slot::of(program->table_region),
                 Slot::of(sums.open >= 0 ? sums.open : any), Slot::of(any)},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .radius = f.radius,
       .thickness = f.thickness});
  add_resolution(shape, g, sums,
                 {.interleave = settings.blur ? settings.interleave : 1,
                  .paper_cone = settings.cone == ConeEstimate::kPaper,
                  .edge = f.radius},
                 program);
  return {};
}

}  // namespace obscura::vulkan
