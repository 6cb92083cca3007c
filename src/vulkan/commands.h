#ifndef OBSCURA_SRC_VULKAN_COMMANDS_H_
#define OBSCURA_SRC_VULKAN_COMMANDS_H_

#include <span>

#include "gpu/frame_constants.h"
#include "gpu/pass.h"
#include "vulkan/functions.h"
#include "vulkan/pipelines.h"

namespace obscura::vulkan {

// Later passes wait for what stage `from` has written.
void record_barrier(const Functions& f, VkCommandBuffer commands, VkPipelineStageFlags from,
                    VkAccessFlags written);

// Later passes wait for earlier compute and transfer work.
void record_wait(const Functions& f, VkCommandBuffer commands);

// Copies numbers into a buffer, after earlier work on it: another recorder may have used the same
// memory just before.
void record_upload(const Functions& f, VkCommandBuffer commands, VkBuffer buffer,
                   VkDeviceSize start, std::span<const float> values);

// One pass. `push` are its own push constants.
void record_pass(const Functions& f, VkCommandBuffer commands, const Pipeline& pipeline,
                 VkDescriptorSet set, const gpu::Pass& pass, gpu::FrameConstants constants,
                 std::span<const std::uint32_t> push);

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_VULKAN_COMMANDS_H_
