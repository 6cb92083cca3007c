#ifndef OBSCURA_SRC_VULKAN_FUNCTIONS_H_
#define OBSCURA_SRC_VULKAN_FUNCTIONS_H_

#include <vulkan/vulkan_core.h>

namespace obscura::vulkan {

// What is called of the caller's device.
#define OBSCURA_VULKAN_FUNCTIONS(X) \
  X(AllocateDescriptorSets)         \
  X(CmdBindDescriptorSets)          \
  X(CmdBindPipeline)                \
  X(CmdDispatch)                    \
  X(CmdPipelineBarrier)             \
  X(CmdPushConstants)               \
  X(CmdUpdateBuffer)                \
  X(CmdWriteTimestamp)              \
  X(CreateComputePipelines)         \
  X(CreateDescriptorPool)           \
  X(CreateDescriptorSetLayout)      \
  X(CreatePipelineLayout)           \
  X(CreateShaderModule)             \
  X(DestroyDescriptorPool)          \
  X(DestroyDescriptorSetLayout)     \
  X(DestroyPipeline)                \
  X(DestroyPipelineLayout)          \
  X(DestroyShaderModule)            \
  X(UpdateDescriptorSets)

struct Functions {
#define OBSCURA_VULKAN_MEMBER(name) PFN_vk##name name = nullptr;
  OBSCURA_VULKAN_FUNCTIONS(OBSCURA_VULKAN_MEMBER)
#undef OBSCURA_VULKAN_MEMBER

  // False if the device lacks one.
  bool load(VkDevice device, PFN_vkGetDeviceProcAddr get) {
    bool complete = true;
#define OBSCURA_VULKAN_LOAD(name)                                 \
  name = reinterpret_cast<PFN_vk##name>(get(device, "vk" #name)); \
  complete = complete && name;
    OBSCURA_VULKAN_FUNCTIONS(OBSCURA_VULKAN_LOAD)
#undef OBSCURA_VULKAN_LOAD
    return complete;
  }
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_VULKAN_FUNCTIONS_H_
