#ifndef OBSCURA_SRC_GPU_PROGRAM_H_
#define OBSCURA_SRC_GPU_PROGRAM_H_

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/shader.h"
#include "obscura/vulkan.h"

namespace obscura::vulkan {

// What a pass reads or writes at one binding: an image of the frame, or a region of the scratch
// memory by its number.
struct Slot {
  enum Kind {
    kRegion,
    kDepthImage,
    kBackDepthImage,
    kNormalImage,
    kVisibilityImage,
    kBentNormalImage
  };
  Kind kind = kRegion;
  int region = 0;

  static Slot of(int region) { return {kRegion, region}; }
  static Slot image(Kind kind) { return {kind, 0}; }
  bool operator==(const Slot&) const = default;
};

// A shader's own push constants, after FrameConstants; Vulkan promises room for 128 bytes in all.
inline constexpr std::size_t kMaxPush = 16;

struct Pass {
  const char* name;  // passes of equal name are one in reports
  Shader spirv;
  std::vector<std::uint32_t> constants{};  // specialization constants 0, 1, ...; bool as 0 and 1
  std::vector<Slot> slots{};               // binding 0, 1, ...
  int width = 1, height = 1, layers = 1;   // invocations in x and y, groups in z
  int group_x = 8, group_y = 8;            // what of them one group does
  float radius = 0, thickness = 0;         // in FrameConstants
  std::vector<std::uint32_t> push{};       // PASS_CONSTANTS of view.glsl, at most kMaxPush
  bool overlaps = false;    // depends on nothing that the pass before writes: no barrier between
  bool half = false;        // FrameConstants are those of half_shape()
  bool to_scratch = false;  // the shader's second form
  VkDeviceSize bytes = 0;   // that it touches, if not all of what its slots name

  std::span<const std::uint32_t> words() const {
    return to_scratch ? spirv.to_scratch : spirv.words;
  }
};

// The passes that every method begins with: linear depth, then normals where they are wanted.
struct Geometry {
  int depth = -1, normals = -1;  // regions; normals -1: none
  int back = -1;                 // see add_back_depth
};

// A method as passes over regions of scratch memory, one after the other. Passes whose shader,
// constants and kinds of slots are equal share a pipeline.
struct Program {
  std::vector<VkDeviceSize> regions;  // bytes
  std::vector<Pass> passes;
  std::vector<float> tables;  // uploaded once to `table_region`
  int table_region = -1;
  Geometry geometry{};  // where it is there already

  int add_region(VkDeviceSize bytes) {
    regions.push_back(bytes);
    return static_cast<int>(regions.size()) - 1;
  }
  // Appends to the tables; returns where, in floats.
  std::uint32_t add_table(std::span<const float> values) {
    if (table_region < 0) table_region = add_region(0);
    const auto start = static_cast<std::uint32_t>(tables.size());
    tables.insert(tables.end(), values.begin(), values.end());
    regions[table_region] = tables.size() * sizeof(float);
    return start;
  }
};

inline int visible_width(const FrameShape& s) {
  return s.width - s.guard_band.left - s.guard_band.right;
}
inline int visible_height(const FrameShape& s) {
  return s.height - s.guard_band.top - s.guard_band.bottom;
}

// Adds the passes of the geometry, or gives the program's own.
Geometry add_geometry(const FrameShape& shape, bool normals, Program* program);

// Adds where matter ends, linear depth (FrameShape::back_depth), or gives the program's own region.
int add_back_depth(const FrameShape& shape, Program* program);

// The passes of a method, or a refusal of its settings. The gpu.cpp of each method holds the
// specialisation for its settings, if MethodInfo says that it runs on Vulkan.
template <class Settings>
Status make_program(const Settings& settings, const FrameShape& shape, Program* program);

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_GPU_PROGRAM_H_
