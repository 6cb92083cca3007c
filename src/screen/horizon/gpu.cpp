#include <bit>

#include "filters/interleaved/gpu.h"
#include "screen/horizon/kernel.h"
#include "screen/horizon/plan.h"
#include "shaders/horizon.h"

namespace obscura::vulkan {
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
Status make_program(const HorizonSettings& settings, const FrameShape& shape, Program* program) {
  HorizonPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  const auto& [rho, f] = plan;
  if (shape.normal_use == NormalUse::kNone) {
    return unsupported("horizon needs normals; normal_use is none");
  }
  const bool classic = settings.variant == HorizonVariant::kClassic;
  const bool directions = shape.directions != Directions::kNone;
  const Geometry g = add_geometry(shape, true, program);
  program->tables = tables_of(f, rho);
  program->table_region = program->add_region(program->tables.size() * sizeof(float));
  const SumRegions sums = add_sums(shape, !directions, directions, program);
  auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  program->passes.push_back(
      {.name = "sample",
       .spirv = shaders::horizon,
       .constants = {static_cast<std::uint32_t>(f.directions), static_cast<std::uint32_t>(f.steps),
                     static_cast<std::uint32_t>(f.interleave), classic,
                     static_cast<std::uint32_t>(rho.kind), f.chord,
                     static_cast<std::uint32_t>(directions ? SliceSums::kUniform
                                                           : SliceSums::kVisibility)},
       .slots = {Slot::of(g.depth), Slot::of(g.normals), Slot::of(program->table_region),
                 Slot::of(directions ? sums.directions : sums.open),
                 Slot::of(directions ? sums.directions : sums.open)},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .radius = f.reach,
       .push = {bits(rho.radius), bits(rho.inverse_radius), bits(rho.entries_per_length),
                static_cast<std::uint32_t>(rho.last_entry), bits(f.bias_sine),
                bits(f.bias_cosine)}});
  add_resolution(shape, g, sums,
                 {.interleave = settings.blur ? settings.interleave : 1,
                  .cosine_open = !classic,
                  .paper_cone = settings.cone == ConeEstimate::kPaper,
                  .edge = rho.radius,
                  .longest_edge = horizon::kLongestEdge},
                 program);
  return {};
}

}  // namespace obscura::vulkan
