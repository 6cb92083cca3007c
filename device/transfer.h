#ifndef OBSCURA_DEVICE_TRANSFER_H_
#define OBSCURA_DEVICE_TRANSFER_H_

#include "device/resources.h"

// Images between ordinary memory and the device.
namespace obscura::tools {

// Copies pixels into an upload buffer; three channels become four.
void fill(const ImageView<const float>& image, const Buffer& to);
void fill(const VectorView<const float>& image, const Buffer& to);

// Records the copy of an upload buffer into its image, which shaders may then read in this layout.
void upload(VkCommandBuffer commands, const Input& input,
            VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);

void make_writable(VkCommandBuffer commands, const Output& output);

// Records the copy of an image into its download buffer, which the host may then read.
void fetch(VkCommandBuffer commands, const Output& output);

// Channel `c` of a fetched image, scaled and moved, if anybody wants it.
void read(const Output& from, int c, float scale, float offset, const ImageView<float>& out);

}  // namespace obscura::tools

#endif  // OBSCURA_DEVICE_TRANSFER_H_
