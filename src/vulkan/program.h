#ifndef OBSCURA_SRC_VULKAN_PROGRAM_H_
#define OBSCURA_SRC_VULKAN_PROGRAM_H_

#include <cstdint>
#include <span>
#include <vector>

#include "obscura/vulkan.h"

namespace obscura::vulkan {

// What a pass reads or writes at one binding: an image of the frame, or a region of the scratch
// memory by its number.
struct Slot {
  enum Kind { kRegion, kDepthImage, kNormalImage, kVisibilityImage };
  Kind kind = kRegion;
  int region = 0;

  static Slot of(int region) { return {kRegion, region}; }
  static Slot image(Kind kind) { return {kind, 0}; }
};

struct Pass {
  const char* name;
  std::span<const std::uint32_t> spirv;
  std::vector<std::uint32_t> constants;  // specialization constants 0, 1, ...; bool as 0 and 1
  std::vector<Slot> slots;               // binding 0, 1, ...
  int width, height;                     // invocations; groups are 8x8
};

// A method as passes over regions of scratch memory, one after the other.
struct Program {
  std::vector<VkDeviceSize> regions;  // bytes
  std::vector<Pass> passes;
  std::vector<float> tables;  // uploaded once to `table_region`
  int table_region = -1;
  float radius = 0, thickness = 0;

  int add_region(VkDeviceSize bytes) {
    regions.push_back(bytes);
    return static_cast<int>(regions.size()) - 1;
  }
};

// The passes that every method begins with: linear depth, then normals where they are wanted.
struct Geometry {
  int depth = -1, normals = -1;  // regions; normals -1: none
};
Geometry add_geometry(const FrameShape& shape, bool normals, Program* program);

Status make_program(const LineSettings& settings, const FrameShape& shape, Program* program);

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_VULKAN_PROGRAM_H_
