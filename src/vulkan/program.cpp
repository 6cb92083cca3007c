#include "vulkan/program.h"

#include "shaders/depth.h"
#include "shaders/normals.h"

namespace obscura::vulkan {
Geometry add_geometry(const FrameShape& shape, bool normals, Program* program) {
  if (program->geometry.depth >= 0) return program->geometry;
  const auto pixels = static_cast<VkDeviceSize>(shape.width) * shape.height;
  const auto visible = static_cast<VkDeviceSize>(visible_width(shape)) * visible_height(shape);
  Geometry g;
  g.depth = program->add_region(pixels * sizeof(float));
  program->passes.push_back({.name = "depth",
                             .spirv = shaders::depth,
                             .constants = {static_cast<std::uint32_t>(shape.depth_kind)},
                             .slots = {Slot::image(Slot::kDepthImage), Slot::of(g.depth)},
                             .width = shape.width,
                             .height = shape.height});
  if (!normals) return g;
  g.normals = program->add_region(visible * 4 * sizeof(float));
  // A binding wants an image even where the pass is specialised not to read it.
  const Slot given = Slot::image(shape.normals ? Slot::kNormalImage : Slot::kDepthImage);
  program->passes.push_back({.name = "normals",
                             .spirv = shaders::normals,
                             .constants = {shape.normals ? 1u : 0u},
                             .slots = {Slot::of(g.depth), Slot::of(g.normals), given},
                             .width = visible_width(shape),
                             .height = visible_height(shape)});
  return g;
}

}  // namespace obscura::vulkan
