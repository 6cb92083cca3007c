#ifndef OBSCURA_DEVICE_VULKAN_DEVICE_H_
#define OBSCURA_DEVICE_VULKAN_DEVICE_H_

#include <volk.h>

#include <string>
#include <vector>

#include "device/headless.h"

namespace obscura::tools {

// An instance, the device chosen on it, and one queue with a command buffer that is recorded,
// submitted and waited for.
class VulkanDevice {
 public:
  static constexpr std::uint32_t kQueries = 1024;

  VulkanDevice() = default;
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;
  ~VulkanDevice();

  Status create(const HeadlessOptions& options);

  const VulkanDeviceInfo& info() const { return info_; }
  const std::vector<std::string>& messages() const { return messages_; }
  VkDevice device() const { return device_; }
  VkCommandBuffer commands() const { return commands_; }
  VkQueryPool queries() const { return queries_; }  // kQueries timestamps
  double tick_ns() const { return tick_ns_; }
  // Between two timestamps of work that has been submitted.
  double ms_between(std::uint32_t first, std::uint32_t second) const;
  std::uint32_t max_storage_buffer_range() const { return max_storage_buffer_range_; }

  // Memory on the device, or of the host and coherent.
  bool allocate(const VkMemoryRequirements& needs, bool host, VkDeviceMemory* memory) const;

  void begin() const;
  Status submit() const;  // and waits

 private:
  Status make_device();

  std::vector<std::string> messages_;
  VulkanDeviceInfo info_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  double tick_ns_ = 1;
  std::uint32_t max_storage_buffer_range_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
};

}  // namespace obscura::tools

#endif  // OBSCURA_DEVICE_VULKAN_DEVICE_H_
