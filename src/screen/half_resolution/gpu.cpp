#include "screen/half_resolution/gpu.h"

#include <bit>

#include "filters/upsampling/kernel.h"
#include "shaders/halve.h"
#include "shaders/upsampling.h"

namespace obscura::vulkan {
namespace {

// What the method gives, in scratch memory.
struct HalfResults {
  int visibility = -1, directions = -1;
};

Geometry add_half_geometry(const FrameShape& shape, const Geometry& whole, Program* program) {
  const view::HalfAxis x = half_columns(shape), y = half_rows(shape);
  const auto pixels = static_cast<VkDeviceSize>(x.size) * y.size;
  const auto visible = static_cast<VkDeviceSize>(x.visible) * y.visible;
  const bool normals = whole.normals >= 0;
  Geometry half;
  half.depth = program->add_region(pixels * sizeof(float));
  if (normals) half.normals = program->add_region(visible * 4 * sizeof(float));
  std::vector<std::uint32_t> push;
  for (int value : {x.first, y.first, x.size, y.size, x.before, y.before, x.visible, y.visible}) {
    push.push_back(static_cast<std::uint32_t>(value));
  }
  program->passes.push_back(
      {.name = "halve",
       .spirv = shaders::halve,
       .constants = {normals},
       .slots = {Slot::of(whole.depth), Slot::of(normals ? whole.normals : whole.depth),
                 Slot::of(half.depth), Slot::of(normals ? half.normals : half.depth)},
       .width = x.size,
       .height = y.size,
       .push = push});
  if (whole.back >= 0) {
    half.back = program->add_region(pixels * sizeof(float));
    program->passes.push_back({.name = "halve",
                               .spirv = shaders::halve,
                               .constants = {0},
                               .slots = {Slot::of(whole.back), Slot::of(whole.back),
                                         Slot::of(half.back), Slot::of(half.back)},
                               .width = x.size,
                               .height = y.size,
                               .push = push,
                               .overlaps = true});
  }
  return half;
}

// Makes the passes from `first` on work at half resolution and leave their results to others.
Status redirect(std::size_t first, const HalfResults& results, Program* program) {
  for (std::size_t i = first; i < program->passes.size(); ++i) {
    Pass& pass = program->passes[i];
    pass.half = true;
    for (Slot& slot : pass.slots) {
      const bool visibility = slot.kind == Slot::kVisibilityImage;
      if (!visibility && slot.kind != Slot::kBentNormalImage) continue;
      if (pass.spirv.to_scratch.empty()) {
        return unsupported("on Vulkan this method works at full resolution only");
      }
      pass.to_scratch = true;
      slot = Slot::of(visibility ? results.visibility : results.directions);
    }
  }
  return {};
}

}  // namespace

FrameShape half_shape(const FrameShape& shape) {
  const view::HalfAxis x = half_columns(shape), y = half_rows(shape);
  FrameShape half = shape;
  half.width = x.size;
  half.height = y.size;
  half.guard_band = {x.before, x.after(), y.before, y.after()};
  if (shape.directions != Directions::kNone) half.directions = Directions::kSigned;
  return half;
}

Status make_half_program(const FrameShape& shape, const MakeProgram& make, Program* program) {
  const FrameShape half = half_shape(shape);
  const bool normals = shape.normal_use != NormalUse::kNone;
  const bool directions = shape.directions != Directions::kNone;
  const auto visible = static_cast<VkDeviceSize>(visible_width(half)) * visible_height(half);
  Geometry whole = add_geometry(shape, normals, program);
  if (shape.back_depth) whole.back = add_back_depth(shape, program);
  program->geometry = add_half_geometry(shape, whole, program);
  HalfResults results;
  results.visibility = program->add_region(visible * sizeof(float));
  results.directions =
      directions ? program->add_region(visible * 4 * sizeof(float)) : results.visibility;
  const std::size_t first = program->passes.size();
  if (Status s = make(half, program); !s.ok()) return s;
  if (Status s = redirect(first, results, program); !s.ok()) return s;
  program->passes.push_back(
      {.name = "fill in",
       .spirv = shaders::upsampling,
       .constants = {normals, directions, shape.directions == Directions::kUnsigned},
       .slots = {Slot::of(whole.depth), Slot::of(normals ? whole.normals : whole.depth),
                 Slot::of(results.visibility), Slot::of(results.directions),
                 Slot::image(Slot::kVisibilityImage),
                 Slot::image(directions ? Slot::kBentNormalImage : Slot::kVisibilityImage)},
       .width = visible_width(shape),
       .height = visible_height(shape),
       .push = {std::bit_cast<std::uint32_t>(kBetweenEdge)}});
  return {};
}

}  // namespace obscura::vulkan
