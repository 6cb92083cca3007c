#ifndef OBSCURA_SRC_VULKAN_PIPELINES_H_
#define OBSCURA_SRC_VULKAN_PIPELINES_H_

#include <vector>

#include "gpu/frame_constants.h"
#include "gpu/pass.h"
#include "obscura/vulkan.h"
#include "vulkan/functions.h"

namespace obscura::vulkan {

inline VkDescriptorType type_of(const gpu::Slot& slot) {
  if (slot.kind == gpu::Slot::kRegion) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  return slot.is_result() ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
}

// Of FrameConstants and the pass's own.
inline std::uint32_t push_bytes(const gpu::Pass& pass) {
  return static_cast<std::uint32_t>(sizeof(gpu::FrameConstants) +
                                    pass.push.size() * sizeof(std::uint32_t));
}

struct Pipeline {
  const gpu::Pass* made_for = nullptr;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

// The pipelines of passes; those that differ in what is bound and pushed only share one.
class Pipelines {
 public:
  Pipelines(const Functions& functions, const Device& device) : f_(functions), device_(device) {}
  ~Pipelines();
  Pipelines(const Pipelines&) = delete;
  Pipelines& operator=(const Pipelines&) = delete;

  // The number of a pass's pipeline, made if there is none yet. The pass must stay where it is.
  // False if the device could not make it.
  bool find_or_make(const gpu::Pass& pass, std::size_t* number);
  const Pipeline& operator[](std::size_t number) const { return pipelines_[number]; }

 private:
  bool make(const gpu::Pass& pass, Pipeline* pipeline);
  bool make_layout(const gpu::Pass& pass, Pipeline* pipeline);
  bool compile(const gpu::Pass& pass, Pipeline* pipeline);

  const Functions& f_;
  const Device& device_;
  std::vector<Pipeline> pipelines_;
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_VULKAN_PIPELINES_H_
