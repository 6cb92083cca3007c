#include "filters/interleaved/gpu.h"
#include "math/slice_sums.h"
#include "screen/gpu.h"
#include "screen/horizon/plan.h"
#include "shaders/horizon.h"
#include "view/gpu.h"

namespace obscura::gpu {
namespace {

std::vector<float> tables_of(const horizon::Frame& f, const math::Rho& rho) {
  std::vector<float> tables;
  for (int k = 0; k < f.directions; ++k) {
    for (float value : {f.cosine[k], f.sine[k], f.shift[k]}) tables.push_back(value);
  }
  for (int y = 0; y < f.interleave; ++y) {
    for (int x = 0; x < f.interleave; ++x) {
      for (const auto& plane : f.tile) tables.push_back(plane[y][x]);
    }
  }
  tables.insert(tables.end(), rho.table.begin(), rho.table.end());
  return tables;
}

}  // namespace

template <>
Status make_program(const HorizonSettings& settings, const Frame& frame, Program* program) {
  namespace io = horizon_io;
  HorizonPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  const auto& [rho, f] = plan;
  const Demands demands{.method = "horizon", .normals = true, .directions = true};
  if (Status s = check(demands, frame.shape); !s.ok()) return s;
  const bool classic = settings.variant == HorizonVariant::kClassic;
  if (Status s = check_back_depth(settings.occluder, frame.shape); !s.ok()) return s;
  const Geometry g = add_geometry(frame, true, program);
  const int back =
      f.matter == view::Matter::kWithBack ? add_back_depth(frame, g, program) : g.depth;
  program->add_table(tables_of(f, rho));
  const SumRegions sums = add_sums(frame, !frame.directions(), frame.directions(), program);
  const SliceSums kind = frame.directions() ? SliceSums::kUniform : SliceSums::kVisibility;
  program->add({.name = "sample",
                .shader = shaders::horizon,
                .constants = {{io::kDirections, f.directions},
                              {io::kSteps, f.steps},
                              {io::kInterleave, f.interleave},
                              {io::kClassic, classic},
                              {io::kFalloff, static_cast<int>(rho.kind)},
                              {io::kChord, f.chord},
                              {io::kSums, static_cast<int>(kind)},
                              {io::kMatter, static_cast<int>(f.matter)}},
                .slots = {{io::kDepthAt, g.depth},
                          {io::kNormalsAt, g.normals},
                          {io::kTablesAt, program->table_region},
                          {io::kOpenAt, sums.any()},
                          {io::kDirectionsAt, sums.any()},
                          {io::kBackAt, back}},
                .size = frame.visible(),
                .radius = f.reach,
                .thickness = f.thickness,
                .push = push_words(io::Push{.rho_radius = rho.radius,
                                            .inverse_radius = rho.inverse_radius,
                                            .entries_per_length = rho.entries_per_length,
                                            .last_entry = rho.last_entry,
                                            .bias_sine = f.bias_sine,
                                            .bias_cosine = f.bias_cosine})});
  add_denoising(frame, g, sums,
                {.interleave = settings.blur ? settings.interleave : 1,
                 .cosine_open = !classic,
                 .paper_cone = settings.cone == ConeEstimate::kPaper,
                 .edge = rho.radius,
                 .edges_per_depth = horizon::kEdgesPerDepth},
                program);
  return {};
}

}  // namespace obscura::gpu
