#ifndef OBSCURA_VULKAN_H_
#define OBSCURA_VULKAN_H_

#include <vulkan/vulkan_core.h>

#include <memory>
#include <span>

#include "obscura/estimator.h"
#include "obscura/export.h"
#include "obscura/frame_shape.h"

// Estimators on the caller's Vulkan device, recorded into the caller's command buffer. Vulkan 1.1
// and the feature shaderStorageImageWriteWithoutFormat; nothing is linked against the loader.
// docs/vulkan.md lists the methods. The whole header is experimental (docs/compatibility.md).
namespace obscura::vulkan {

// The caller's; must outlive every Recorder made from it.
struct Device {
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
  VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  // optional
  // VkPhysicalDeviceLimits::maxStorageBufferRange; what every device has unless more is said.
  std::uint32_t max_storage_buffer_range = 1u << 27;
};

using gpu::Directions;
using gpu::FrameShape;
using gpu::FrameView;

// Images of one frame; views of the whole image, colour aspect or depth aspect.
struct FrameImages {
  VkImageView depth = VK_NULL_HANDLE;  // R32_SFLOAT or D32_SFLOAT, SHADER_READ_ONLY_OPTIMAL
  // Eye space, as DepthField::normals: any float or SNORM format, SHADER_READ_ONLY_OPTIMAL.
  VkImageView normals = VK_NULL_HANDLE;
  // Visible size; R8_UNORM, R16_SFLOAT or R32_SFLOAT, in GENERAL while recorded work runs.
  VkImageView visibility = VK_NULL_HANDLE;
  // Visible size, in GENERAL; where FrameShape::directions asks for it.
  VkImageView bent_normal = VK_NULL_HANDLE;
  // As depth and of its kind; where FrameShape::back_depth says so.
  VkImageView back_depth = VK_NULL_HANDLE;
};

// Memory that the caller provides for what passes hand on: STORAGE_BUFFER and TRANSFER_DST usage,
// device-local. One is enough for all frames on one queue. Recorders may share it on one queue, if
// record_tables() of each comes before its record() again whenever another has used the memory.
struct Scratch {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  // a multiple of 256
};

struct RecordOptions {
  // A pool of timestamps, or null: record() then writes timestamp `first_query + i` after pass i,
  // and before the first one `first_query`; pass_names() + 1 queries, reset by the caller.
  VkQueryPool timestamps = VK_NULL_HANDLE;
  std::uint32_t first_query = 0;
};

// One estimator's pipelines. record() neither allocates nor submits, waits or maps.
//
// Invalid depth (zero, negative, NDC outside [0, 1]) counts as background here; the CPU's
// Estimator refuses it.
class OBSCURA_API OBSCURA_EXPERIMENTAL Recorder {
 public:
  Recorder();
  ~Recorder();
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  // Makes pipelines; settings, sizes or a device that cannot be used are refused with a message.
  static Status create(const Device& device, const MethodSettings& settings,
                       const FrameShape& shape, Recorder* recorder);

  VkDeviceSize scratch_bytes() const;
  void bind_scratch(const Scratch& scratch);
  // `frame` is below FrameShape::frames and not in flight. After bind_scratch.
  Status bind_images(int frame, const FrameImages& images);

  // Once, before the first record(): fills the tables in the scratch memory. Waits, on the device,
  // for earlier compute and transfer work.
  void record_tables(VkCommandBuffer commands) const;

  // Waits, on the device, for earlier compute and transfer work on the scratch memory; the caller's
  // barriers make depth and normals visible to COMPUTE_SHADER reads, and make the visibility that
  // it writes there visible to what follows.
  //
  // Records nothing and says why where a frame has no images or a view cannot be (a camera without
  // scale; for NDC depth a near plane of 0 or a far plane before it).
  Status record(VkCommandBuffer commands, int frame, const FrameView& view,
                const RecordOptions& options = {}) const;

  std::span<const char* const> pass_names() const;
  // Memory that each pass reads or writes, every byte counted once; images as 4 bytes per texel.
  std::span<const VkDeviceSize> pass_bytes() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_VULKAN_H_
