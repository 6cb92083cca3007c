#ifndef OBSCURA_SRC_VULKAN_CHECKS_H_
#define OBSCURA_SRC_VULKAN_CHECKS_H_

#include "obscura/vulkan.h"

namespace obscura::vulkan {

Status check(const Device& device);
Status check_frame(int frame, const FrameShape& shape);
// All that the shape asks for.
Status check(const FrameImages& images, const FrameShape& shape);

// That it is bound, and where; `what` names it.
Status check_memory(const Scratch& memory, const char* what);

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_VULKAN_CHECKS_H_
