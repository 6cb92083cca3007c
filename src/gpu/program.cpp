#include "gpu/program.h"

#include "shaders/depth.h"
#include "shaders/normals.h"

namespace obscura::vulkan {
namespace {

VkDeviceSize depth_bytes(const FrameShape& shape) {
  return static_cast<VkDeviceSize>(shape.width) * shape.height * sizeof(float);
}

// Linear depth of an image of depth.
Pass conversion(const FrameShape& shape, Slot::Kind image, int region) {
  return {.name = "depth",
          .spirv = shaders::depth,
          .constants = {static_cast<std::uint32_t>(shape.depth_kind)},
          .slots = {Slot::image(image), Slot::of(region)},
          .width = shape.width,
          .height = shape.height};
}

}  // namespace

Geometry add_geometry(const FrameShape& shape, bool normals, Program* program) {
  if (program->geometry.depth >= 0) return program->geometry;
  const auto visible = static_cast<VkDeviceSize>(visible_width(shape)) * visible_height(shape);
  Geometry g;
  g.depth = program->add_region(depth_bytes(shape));
  program->passes.push_back(conversion(shape, Slot::kDepthImage, g.depth));
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

int add_back_depth(const FrameShape& shape, Program* program) {
  if (program->geometry.back >= 0) return program->geometry.back;
  const int back = program->add_region(depth_bytes(shape));
  program->passes.push_back(conversion(shape, Slot::kBackDepthImage, back));
  program->passes.back().overlaps = true;
  return back;
}

}  // namespace obscura::vulkan
