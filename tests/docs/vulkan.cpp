// docs/vulkan.md, compiled only: the renderer's own variables are arguments.
#include "vulkan_includes.inc"

// What a renderer has already.
struct Renderer {
  VkDevice device;
  VkPipelineCache pipeline_cache;
  VkBuffer buffer;
  VkImageView depth_view0, visibility_view0, depth_view1, visibility_view1;
  VkCommandBuffer commands;
  double matrix[16];
  float near_plane, far_plane;
  int frame;
  std::uint32_t frame_index;
};

bool record_vulkan(const Renderer& renderer, PFN_vkGetDeviceProcAddr vkGetDeviceProcAddr) {
  const auto& [device, pipeline_cache, buffer, depth_view0, visibility_view0, depth_view1,
               visibility_view1, commands, matrix, near_plane, far_plane, frame, frame_index] =
      renderer;
#include "vulkan.inc"
  return status.ok();
}
