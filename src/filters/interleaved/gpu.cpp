#include "filters/interleaved/gpu.h"

#include <bit>

#include "shaders/farthest.h"
#include "shaders/interleaved.h"

namespace obscura::vulkan {
namespace {

constexpr int kTile = 16;  // pixels a side that a group resolves
constexpr int kFarthestGroups = 256, kFarthestSize = 128;

// Depends on depth alone, which a barrier before the samples has made ready.
int add_farthest(const Geometry& g, Program* program) {
  const int region = program->add_region(kFarthestGroups * sizeof(float));
  program->passes.push_back({.name = "farthest",
                             .spirv = shaders::farthest,
                             .constants = {},
                             .slots = {Slot::of(g.depth), Slot::of(region)},
                             .width = kFarthestGroups * kFarthestSize,
                             .group_x = kFarthestSize,
                             .group_y = 1,
                             .overlaps = true});
  return region;
}

}  // namespace

SumRegions add_sums(const FrameShape& shape, bool open, bool directions, Program* program) {
  const auto pixels = static_cast<VkDeviceSize>(visible_width(shape)) * visible_height(shape);
  SumRegions sums;
  if (open) sums.open = program->add_region(pixels * sizeof(float));
  if (directions) sums.directions = program->add_region(pixels * 4 * sizeof(float));
  return sums;
}

void add_resolution(const FrameShape& shape, const Geometry& geometry, const SumRegions& sums,
                    const Resolution& how, Program* program) {
  const bool open = sums.open >= 0, directions = sums.directions >= 0;
  const bool bounded = how.longest_edge > 0 && how.interleave > 1;
  const int reach = how.interleave / 2;
  const int farthest = bounded ? add_farthest(geometry, program) : geometry.depth;
  const VisibilityTarget target =
      how.target ? *how.target : VolumetricTargets(shape, {}, false, program).first();
  // Every binding needs something, read or not.
  const Slot open_slot = Slot::of(open ? sums.open : sums.directions);
  Pass pass{.name = "blur",
            .spirv = shaders::interleaved,
            .constants = target.constants,
            .slots = target.slots,
            .width = visible_width(shape),
            .height = visible_height(shape),
            .group_x = kTile,
            .group_y = kTile,
            .radius = how.edge,
            .push = {std::bit_cast<std::uint32_t>(how.longest_edge)}};
  const bool normals = geometry.normals >= 0;
  for (std::uint32_t constant :
       {static_cast<std::uint32_t>(reach), std::uint32_t{how.interleave % 2 == 0},
        (open ? 1u : 0u) + (directions ? 4u : 0u), std::uint32_t{open}, std::uint32_t{directions},
        std::uint32_t{how.cosine_open}, std::uint32_t{how.paper_cone},
        std::uint32_t{shape.directions == Directions::kUnsigned},
        bounded ? std::uint32_t{kFarthestGroups} : 0u, std::uint32_t{normals}}) {
    pass.constants.push_back(constant);
  }
  for (const Slot& slot :
       {Slot::of(geometry.depth), Slot::of(normals ? geometry.normals : geometry.depth), open_slot,
        directions ? Slot::of(sums.directions) : open_slot, Slot::of(farthest),
        Slot::image(directions ? Slot::kBentNormalImage : Slot::kVisibilityImage)}) {
    pass.slots.push_back(slot);
  }
  program->passes.push_back(std::move(pass));
}

}  // namespace obscura::vulkan
