#include "device/resources.h"

namespace obscura::tools {

Resources::~Resources() {
  for (const Buffer& b : buffers_) {
    vkDestroyBuffer(device_.device(), b.buffer, nullptr);
    vkFreeMemory(device_.device(), b.memory, nullptr);
  }
  for (const Picture& p : pictures_) {
    vkDestroyImageView(device_.device(), p.view, nullptr);
    vkDestroyImage(device_.device(), p.image, nullptr);
    vkFreeMemory(device_.device(), p.memory, nullptr);
  }
}

bool Resources::buffer(VkDeviceSize bytes, VkBufferUsageFlags usage, bool host, Buffer* result) {
  Buffer& b = buffers_.emplace_back();
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  if (vkCreateBuffer(device_.device(), &info, nullptr, &b.buffer) != VK_SUCCESS) return false;
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_.device(), b.buffer, &needs);
  if (!device_.allocate(needs, host, &b.memory) ||
      vkBindBufferMemory(device_.device(), b.buffer, b.memory, 0) != VK_SUCCESS) {
    return false;
  }
  if (host &&
      vkMapMemory(device_.device(), b.memory, 0, VK_WHOLE_SIZE, 0, &b.mapped) != VK_SUCCESS) {
    return false;
  }
  *result = b;
  return true;
}

bool Resources::image(int width, int height, VkFormat format, VkImageUsageFlags usage,
                      Picture* result) {
  Picture& p = pictures_.emplace_back();
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
  if (format == VK_FORMAT_D32_SFLOAT) p.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {p.width, p.height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  if (vkCreateImage(device_.device(), &info, nullptr, &p.image) != VK_SUCCESS) return false;
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_.device(), p.image, &needs);
  if (!device_.allocate(needs, false, &p.memory) ||
      vkBindImageMemory(device_.device(), p.image, p.memory, 0) != VK_SUCCESS) {
    return false;
  }
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = p.image;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {p.aspect, 0, 1, 0, 1};
  if (vkCreateImageView(device_.device(), &view, nullptr, &p.view) != VK_SUCCESS) return false;
  *result = p;
  return true;
}

bool Resources::input(int width, int height, VkFormat format, Input* result) {
  const VkDeviceSize texel = format == VK_FORMAT_R32G32B32A32_SFLOAT ? 16 : 4;
  return image(width, height, format, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
               &result->picture) &&
         buffer(texel * width * height, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true, &result->upload);
}

bool Resources::output(int width, int height, VulkanFormat format, int channels, Output* result) {
  constexpr VkFormat kFormats[][3] = {
      {VK_FORMAT_R8_UNORM, VK_FORMAT_R16_SFLOAT, VK_FORMAT_R32_SFLOAT},
      {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT}};
  result->format = format;
  result->channels = channels;
  return image(width, height, kFormats[channels == 4][static_cast<int>(format)],
               VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, &result->picture) &&
         buffer(static_cast<VkDeviceSize>(4) * channels * width * height,
                VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, &result->download);
}

}  // namespace obscura::tools
