#include "vulkan/checks.h"

#include "core/text.h"
#include "vulkan/descriptors.h"

namespace obscura::vulkan {

Status check(const Device& device) {
  if (device.device && device.get_device_proc_addr) return {};
  return invalid_argument("device and get_device_proc_addr must be given");
}

Status check_frame(int frame, const FrameShape& shape) {
  if (frame >= 0 && frame < shape.frames) return {};
  return invalid_argument(text("frame is ", frame, "; it must be in [0, ", shape.frames, ")"));
}

Status check(const FrameImages& images, const FrameShape& shape) {
  if (images.depth && images.visibility && (!shape.normals || images.normals) &&
      (shape.directions == Directions::kNone || images.bent_normal) &&
      (!shape.back_depth || images.back_depth)) {
    return {};
  }
  return invalid_argument(
      "depth, visibility and, if the shape says so, normals, bent_normal and back_depth must be "
      "given");
}

Status check_memory(const Scratch& memory, const char* what) {
  if (!memory.buffer) return invalid_argument(text(what, " must be bound before images"));
  if (memory.offset % kScratchAlignment == 0) return {};
  return invalid_argument(
      text(what, "'s offset is ", memory.offset, "; it must be a multiple of ", kScratchAlignment));
}

}  // namespace obscura::vulkan
