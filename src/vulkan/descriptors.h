#ifndef OBSCURA_SRC_VULKAN_DESCRIPTORS_H_
#define OBSCURA_SRC_VULKAN_DESCRIPTORS_H_

#include <span>
#include <vector>

#include "gpu/pass.h"
#include "obscura/vulkan.h"
#include "obscura/vulkan_light.h"
#include "vulkan/functions.h"
#include "vulkan/pipelines.h"

namespace obscura::vulkan {

// The largest minStorageBufferOffsetAlignment that Vulkan allows.
inline constexpr VkDeviceSize kScratchAlignment = 256;

// Where regions lie in the scratch memory.
struct ScratchLayout {
  std::vector<VkDeviceSize> sizes, offsets;
  VkDeviceSize bytes = 0;

  void add_region(VkDeviceSize size);
};

// What of the caller's images slots may name.
struct BoundImages {
  FrameImages frame{};
  LightImages light{};
};

// The descriptor sets of passes, one per frame; passes that bind the same share them.
class Descriptors {
 public:
  Descriptors(const Functions& functions, const Device& device, const Pipelines& pipelines)
      : f_(functions), device_(device), pipelines_(pipelines) {}
  ~Descriptors();
  Descriptors(const Descriptors&) = delete;
  Descriptors& operator=(const Descriptors&) = delete;

  // The number of a pass's sets.
  std::size_t find_or_add(std::size_t pipeline, const gpu::Pass& pass);
  // Once, after all passes. False if the device has none left.
  bool allocate(int frames);
  void write(int frame, const BoundImages& images, const Scratch& scratch,
             const ScratchLayout& layout) const;
  VkDescriptorSet set(std::size_t number, int frame) const {
    return entries_[number].sets[static_cast<std::size_t>(frame)];
  }

 private:
  struct Entry {
    std::size_t pipeline;
    std::vector<gpu::BoundSlot> slots;
    std::vector<VkDescriptorSet> sets{};  // one per frame
  };

  bool make_pool(std::uint32_t frames);
  void write(VkDescriptorSet set, const gpu::BoundSlot& bound, const BoundImages& images,
             const Scratch& scratch, const ScratchLayout& layout) const;

  const Functions& f_;
  const Device& device_;
  const Pipelines& pipelines_;
  std::vector<Entry> entries_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_VULKAN_DESCRIPTORS_H_
