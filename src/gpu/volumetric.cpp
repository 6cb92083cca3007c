#include "gpu/volumetric.h"

#include <bit>

#include "core/reflection_noise.h"
#include "shaders/bilateral.h"

namespace obscura::vulkan {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 24;  // of bilateral.comp

}  // namespace

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

VolumetricTargets::VolumetricTargets(const FrameShape& shape, const DualRadius& dual, bool blur,
                                     Program* program)
    : dual_(dual.second_radius.has_value()), blur_(blur), combine_(dual.combine) {
  const auto pixels = static_cast<VkDeviceSize>(visible_width(shape)) * visible_height(shape);
  // A binding wants a region even where the pass is specialised not to touch it.
  region_ = program->add_region(dual_ || blur_ ? pixels * sizeof(float) : sizeof(float));
}

VisibilityTarget VolumetricTargets::target(bool to_image, std::uint32_t combine) const {
  return {{to_image, combine}, {Slot::image(Slot::kVisibilityImage), Slot::of(region_)}};
}

void add_sampling(Pass pass, std::span<const std::uint32_t> constants, const FrameShape& shape,
                  const Geometry& g, const VisibilityTarget& target, std::span<const float> pattern,
                  Program* program) {
  pass.push.insert(pass.push.begin(), program->add_table(pattern));
  pass.constants = target.constants;
  pass.constants.insert(pass.constants.end(), constants.begin(), constants.end());
  std::vector<Slot> slots = target.slots;
  for (int region : {g.depth, g.normals >= 0 ? g.normals : g.depth, program->table_region}) {
    slots.push_back(Slot::of(region));
  }
  pass.slots.insert(pass.slots.begin(), slots.begin(), slots.end());
  pass.width = visible_width(shape);
  pass.height = visible_height(shape);
  program->passes.push_back(std::move(pass));
}

void add_blur(const FrameShape& shape, const Geometry& g, int region, float edge,
              Program* program) {
  program->passes.push_back(
      {.name = "blur",
       .spirv = shaders::bilateral,
       .constants = {},
       .slots = {Slot::of(g.depth), Slot::of(region), Slot::image(Slot::kVisibilityImage)},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .group_x = kTileWidth,
       .group_y = kTileHeight,
       .push = {std::bit_cast<std::uint32_t>(edge)}});
}

}  // namespace obscura::vulkan
