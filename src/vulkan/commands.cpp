#include "vulkan/commands.h"

#include <algorithm>
#include <cstring>

namespace obscura::vulkan {
namespace {

constexpr std::size_t kFrameWords = sizeof(gpu::FrameConstants) / sizeof(std::uint32_t);
constexpr VkDeviceSize kMaxUpdate = 65536;  // of vkCmdUpdateBuffer

std::uint32_t groups(int size, int tile) {
  return static_cast<std::uint32_t>((size + tile - 1) / tile);
}

}  // namespace

void record_barrier(const Functions& f, VkCommandBuffer commands, VkPipelineStageFlags from,
                    VkAccessFlags written) {
  const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, written,
                               VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};
  f.CmdPipelineBarrier(commands, from, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &memory, 0,
                       nullptr, 0, nullptr);
}

void record_wait(const Functions& f, VkCommandBuffer commands) {
  record_barrier(f, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                 VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
}

void record_upload(const Functions& f, VkCommandBuffer commands, VkBuffer buffer,
                   VkDeviceSize start, std::span<const float> values) {
  const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr,
                               VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
                               VK_ACCESS_TRANSFER_WRITE_BIT};
  f.CmdPipelineBarrier(commands,
                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
  const VkDeviceSize bytes = values.size_bytes();
  for (VkDeviceSize at = 0; at < bytes; at += kMaxUpdate) {
    f.CmdUpdateBuffer(commands, buffer, start + at, std::min(kMaxUpdate, bytes - at),
                      values.data() + at / sizeof(float));
  }
}

void record_pass(const Functions& f, VkCommandBuffer commands, const Pipeline& pipeline,
                 VkDescriptorSet set, const gpu::Pass& pass, gpu::FrameConstants constants,
                 std::span<const std::uint32_t> own) {
  f.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  f.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0,
                          nullptr);
  constants.radius = pass.radius;
  constants.thickness = pass.thickness;
  // One call for both: calls are most of what recording costs.
  std::uint32_t push[kFrameWords + gpu::kMaxPush];
  std::memcpy(push, &constants, sizeof(constants));
  std::ranges::copy(own, push + kFrameWords);
  f.CmdPushConstants(commands, pipeline.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes(pass),
                     push);
  const Extent tile = pass.shader.io->tile;
  f.CmdDispatch(commands, groups(pass.size.width, tile.width),
                groups(pass.size.height, tile.height), static_cast<std::uint32_t>(pass.layers));
}

}  // namespace obscura::vulkan
