#include "device/transfer.h"

#include <cmath>
#include <cstring>

namespace obscura::tools {
namespace {

VkBufferImageCopy whole(const Picture& p) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = {p.aspect, 0, 0, 1};
  copy.imageExtent = {p.width, p.height, 1};
  return copy;
}

void transition(VkCommandBuffer commands, const Picture& picture, VkImageLayout from,
                VkImageLayout to, VkPipelineStageFlags before, VkAccessFlags written,
                VkPipelineStageFlags after, VkAccessFlags used) {
  VkImageMemoryBarrier b{};
  b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  b.srcAccessMask = written;
  b.dstAccessMask = used;
  b.oldLayout = from;
  b.newLayout = to;
  b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  b.image = picture.image;
  b.subresourceRange = {picture.aspect, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &b);
}

float from_half(std::uint16_t h) {
  const int exponent = (h >> 10) & 31, mantissa = h & 1023;
  const float value = exponent == 0
                          ? std::ldexp(static_cast<float>(mantissa), -24)
                          : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
  return h & 0x8000 ? -value : value;
}

}  // namespace

void fill(const ImageView<const float>& image, const Buffer& to) {
  auto* out = static_cast<float*>(to.mapped);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) *out++ = image(x, y);
  }
}
void fill(const VectorView<const float>& image, const Buffer& to) {
  auto* out = static_cast<float*>(to.mapped);
  for (int y = 0; y < image.x.height; ++y) {
    for (int x = 0; x < image.x.width; ++x) {
      for (const auto* view : {&image.x, &image.y, &image.z}) *out++ = (*view)(x, y);
      *out++ = 0;
    }
  }
}

void upload(VkCommandBuffer commands, const Input& input, VkImageLayout layout) {
  const Picture& to = input.picture;
  transition(commands, to, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
             VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0, VK_PIPELINE_STAGE_TRANSFER_BIT,
             VK_ACCESS_TRANSFER_WRITE_BIT);
  const VkBufferImageCopy copy = whole(to);
  vkCmdCopyBufferToImage(commands, input.upload.buffer, to.image,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  transition(commands, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, layout,
             VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
}

void make_writable(VkCommandBuffer commands, const Output& output) {
  transition(commands, output.picture, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL,
             VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
             VK_ACCESS_SHADER_WRITE_BIT);
}

void fetch(VkCommandBuffer commands, const Output& output) {
  const Picture& from = output.picture;
  transition(commands, from, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
             VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
  const VkBufferImageCopy copy = whole(from);
  vkCmdCopyImageToBuffer(commands, from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                         output.download.buffer, 1, &copy);
  VkMemoryBarrier b{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                    VK_ACCESS_HOST_READ_BIT};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                       &b, 0, nullptr, 0, nullptr);
}

void read(const Output& from, int c, float scale, float offset, const ImageView<float>& out) {
  const auto* bytes = static_cast<const std::uint8_t*>(from.download.mapped);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const std::size_t i = (std::size_t(y) * out.width + x) * from.channels + c;
      float value = static_cast<float>(bytes[i]) / 255;
      std::uint16_t half;
      if (from.format == VulkanFormat::kR16F) {
        std::memcpy(&half, bytes + 2 * i, 2);
        value = from_half(half);
      }
      if (from.format == VulkanFormat::kR32F) std::memcpy(&value, bytes + 4 * i, 4);
      out(x, y) = value * scale + offset;
    }
  }
}

}  // namespace obscura::tools
