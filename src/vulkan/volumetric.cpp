#include "vulkan/volumetric.h"

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

VolumetricTargets::VolumetricTargets(const FrameShape& shape, bool dual, Combine combine, bool blur,
                                     Program* program)
    : dual_(dual), blur_(blur), combine_(combine) {
  const auto pixels = static_cast<VkDeviceSize>(visible_width(shape)) * visible_height(shape);
  // A binding wants a region even where the pass is specialised not to touch it.
  region_ = program->add_region(dual || blur ? pixels * sizeof(float) : sizeof(float));
}

VisibilityTarget VolumetricTargets::target(bool to_image, std::uint32_t combine) const {
  return {{to_image, combine}, {Slot::image(Slot::kVisibilityImage), Slot::of(region_)}};
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
