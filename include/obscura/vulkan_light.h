#ifndef OBSCURA_VULKAN_LIGHT_H_
#define OBSCURA_VULKAN_LIGHT_H_

#include <array>
#include <memory>

#include "obscura/lighting.h"
#include "obscura/vulkan.h"

// Light from visibility, bent normals and cones on the caller's Vulkan device, as light() of
// obscura/lighting.h gives it on the CPU. obscura/glsl/ambient.glsl is for an engine's own shader.
// The whole header is experimental (docs/compatibility.md).
namespace obscura::vulkan {

// Images of one frame. Those that a Recorder has written, or of the same kind.
struct LightImages {
  VkImageView visibility = VK_NULL_HANDLE;  // visible size, sampled, in GENERAL
  // Eye space, whole size (FrameShape), need not be unit; SHADER_READ_ONLY_OPTIMAL.
  VkImageView normals = VK_NULL_HANDLE;
  // As FrameShape::directions says, sampled, in GENERAL; not read by ambient-occlusion.
  VkImageView bent_normal = VK_NULL_HANDLE;
  // Linear RGB, whole size, SHADER_READ_ONLY_OPTIMAL; where LightShape::albedo says so.
  VkImageView albedo = VK_NULL_HANDLE;
  // The result: linear RGB and alpha 1, visible size; RGBA16_SFLOAT or RGBA32_SFLOAT, in GENERAL.
  VkImageView light = VK_NULL_HANDLE;
};

// What stays the same from frame to frame.
struct LightShape {
  FrameShape frame{};   // sizes, guard band, directions and number of frames are read
  bool albedo = false;  // an image of it is given; else 1
  int cells = 32;       // PreconvolutionSettings::cells of the environments
};

// What may change with each frame.
struct LightView {
  // Rotates eye space to world space; row-major, orthonormal. That of the settings is not read.
  std::array<float, 9> world_from_eye{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Sun sun{};  // by default none
};

// One pipeline. record() neither allocates nor submits, waits or maps.
class OBSCURA_API OBSCURA_EXPERIMENTAL LightRecorder {
 public:
  LightRecorder();
  ~LightRecorder();
  LightRecorder(LightRecorder&&) noexcept;
  LightRecorder& operator=(LightRecorder&&) noexcept;

  // Settings, sizes or a device that cannot be used are refused with a message.
  static Status create(const Device& device, const LightingSettings& settings,
                       const LightShape& shape, LightRecorder* recorder);

  // Memory for an environment, which the caller provides: STORAGE_BUFFER and TRANSFER_DST usage,
  // device-local. Recorders of the same `cells` may share it.
  VkDeviceSize environment_bytes() const;
  void bind_environment(const Scratch& memory);
  // `frame` is below FrameShape::frames and not in flight. After bind_environment.
  Status bind_images(int frame, const LightImages& images);

  // Before the first record(), and whenever the light changes: fills the memory with the
  // environment, whose table has LightShape::cells. Waits, on the device, for earlier compute and
  // transfer work. Its sun is LightView's to say.
  Status record_environment(VkCommandBuffer commands,
                            const PreconvolvedEnvironment& environment) const;

  // Waits, on the device, for earlier compute and transfer work, so also for a Recorder's results;
  // the caller makes normals and albedo visible to COMPUTE_SHADER reads, and makes the light that
  // it writes there visible to what follows.
  //
  // Records nothing and says why where a frame has no images, world_from_eye is no rotation or the
  // sun has a direction of length 0.
  Status record(VkCommandBuffer commands, int frame, const LightView& view,
                const RecordOptions& options = {}) const;

  // Memory that record() reads or writes, every byte counted once; images as 4 bytes per channel.
  VkDeviceSize pass_bytes() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_VULKAN_LIGHT_H_
