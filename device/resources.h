#ifndef OBSCURA_DEVICE_RESOURCES_H_
#define OBSCURA_DEVICE_RESOURCES_H_

#include <vector>

#include "device/vulkan_device.h"

namespace obscura::tools {

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};
struct Picture {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::uint32_t width = 0, height = 0;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
};
struct Input {
  Picture picture;
  Buffer upload;
};
struct Output {
  Picture picture;
  Buffer download;
  VulkanFormat format = VulkanFormat::kR32F;
  int channels = 1;
};

// Buffers and images of one run, gone at its end. Each function is false where memory is out.
class Resources {
 public:
  explicit Resources(const VulkanDevice& device) : device_(device) {}
  Resources(const Resources&) = delete;
  Resources& operator=(const Resources&) = delete;
  ~Resources();

  bool buffer(VkDeviceSize bytes, VkBufferUsageFlags usage, bool host, Buffer* result);
  bool image(int width, int height, VkFormat format, VkImageUsageFlags usage, Picture* result);
  bool input(int width, int height, VkFormat format, Input* result);
  bool output(int width, int height, VulkanFormat format, int channels, Output* result);

 private:
  const VulkanDevice& device_;
  std::vector<Buffer> buffers_;
  std::vector<Picture> pictures_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_DEVICE_RESOURCES_H_
