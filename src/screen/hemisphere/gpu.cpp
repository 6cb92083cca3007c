#include "filters/interleaved/gpu.h"
#include "screen/gpu.h"
#include "screen/hemisphere/plan.h"
#include "shaders/hemisphere.h"
#include "view/gpu.h"

namespace obscura::gpu {
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
Status make_program(const HemisphereSettings& settings, const Frame& frame, Program* program) {
  namespace io = hemisphere_io;
  hemisphere::Frame f;
  if (Status s = make_plan(settings, &f); !s.ok()) return s;
  const Demands demands{.method = "hemisphere", .normals = true, .directions = true};
  if (Status s = check(demands, frame.shape); !s.ok()) return s;
  const bool cosine = settings.weighting == RayWeighting::kCosine;
  if (Status s = check_back_depth(settings.occluder, frame.shape); !s.ok()) return s;
  const Geometry g = add_geometry(frame, true, program);
  const bool with_back = f.matter == view::Matter::kWithBack;
  const int back = with_back ? add_back_depth(frame, g, program) : g.depth;
  program->add_table(tables_of(f));
  // Directions have uniform weights; so has then the visibility that is summed with them.
  const SumRegions sums =
      add_sums(frame, cosine || !frame.directions(), frame.directions(), program);
  const bool open = sums.open >= 0;
  program->add({.name = "sample",
                .shader = shaders::hemisphere,
                .constants = {{io::kSamples, f.samples},
                              {io::kTests, f.tests},
                              {io::kInterleave, f.interleave},
                              {io::kQuadratic, f.quadratic},
                              {io::kMatter, static_cast<int>(f.matter)},
                              {io::kOpen, open},
                              {io::kCosine, cosine},
                              {io::kDirections, frame.directions()}},
                .slots = {{io::kDepthAt, g.depth},
                          {io::kNormalsAt, g.normals},
                          {io::kTablesAt, program->table_region},
                          {io::kOpenAt, open ? sums.open : sums.any()},
                          {io::kDirectionsAt, sums.any()},
                          {io::kBackAt, back}},
                .size = frame.visible(),
                .radius = f.radius,
                .thickness = f.thickness});
  add_denoising(frame, g, sums,
                {.interleave = settings.blur ? settings.interleave : 1,
                 .paper_cone = settings.cone == ConeEstimate::kPaper,
                 .edge = f.radius},
                program);
  return {};
}

}  // namespace obscura::gpu
