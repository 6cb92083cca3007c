#include "screen/volumetric/gpu.h"

#include "core/reflection_noise.h"
#include "screen/volumetric/sampling_io.h"

namespace obscura::gpu {

void add_reflections(bool rotate, std::uint32_t seed, bool space, Program* program) {
  if (!rotate) return;
  const ReflectionNoise noise(seed, space);
  std::vector<float> table;
  for (int i = 0; i < ReflectionNoise::kSize * ReflectionNoise::kSize; ++i) {
    table.push_back(noise.x()[i]);
    table.push_back(noise.y()[i]);
    if (space) table.push_back(noise.z()[i]);
  }
  program->add_table(table);
}

VolumetricTargets::VolumetricTargets(const Frame& frame, const DualRadius& dual, bool blur,
                                     Program* program)
    : result_(frame.results.visibility),
      dual_(dual.second_radius.has_value()),
      blur_(blur),
      combine_(dual.combine == Combine::kProduct ? CombineWith::kProduct : CombineWith::kMinimum),
      // A binding wants a region even where the pass is specialised not to touch it.
      region_(program->add_region(dual_ || blur_ ? frame.visible_bytes() : sizeof(float))) {}

void add_sampling(Pass pass, const Sampling& sampling, const Frame& frame, const Geometry& g,
                  const VisibilityTarget& target, Program* program) {
  namespace io = sampling_io;
  const bool normals = g.normals >= 0;
  for (const ConstantValue& c : {ConstantValue{io::kSamples, sampling.samples},
                                 {io::kNormals, normals},
                                 {io::kRotate, sampling.rotate},
                                 {io::kThickness, sampling.thickness},
                                 {io::kNoise, ReflectionNoise::kSize}}) {
    pass.constants.push_back(c);
  }
  for (const BoundSlot& slot : {BoundSlot{io::kDepthAt, g.depth},
                                {io::kNormalsAt, normals ? g.normals : g.depth},
                                {io::kTablesAt, program->table_region}}) {
    pass.slots.push_back(slot);
  }
  target.apply(&pass);
  pass.size = frame.visible();
  program->add(std::move(pass));
}

}  // namespace obscura::gpu
