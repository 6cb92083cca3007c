#ifndef OBSCURA_DEVICE_HEADLESS_H_
#define OBSCURA_DEVICE_HEADLESS_H_

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "obscura/depth_field.h"
#include "obscura/estimator.h"
#include "obscura/lighting.h"

// Estimators on a Vulkan device without a window: images in and out of ordinary memory.
namespace obscura::tools {

struct VulkanDeviceInfo {
  std::string name, driver;
  bool software = false;
};
// Every device that the system's drivers offer, in Vulkan's order.
Status list_vulkan_devices(std::vector<VulkanDeviceInfo>* devices);

struct HeadlessOptions {
  int device = -1;  // by its number in the list; -1: the first that is not software, or the first
  bool validate = false;  // validation layers, core and synchronization
};

struct HeadlessPass {
  const char* name;  // passes of equal name are one
  double ms = 0;     // on the device
  double bytes = 0;  // Recorder::pass_bytes()
};
struct HeadlessTimes {
  double record_us = 0;  // of Recorder::record() on the CPU
  std::vector<HeadlessPass> passes{};

  double total_ms() const;
};

// Formats of the images; RGBA of the bent normal, whose 8 bits are UNORM.
enum class VulkanFormat { kR8, kR16F, kR32F };
struct HeadlessFrame {
  VulkanFormat output = VulkanFormat::kR32F;
  bool depth_buffer = false;  // depth as D32_SFLOAT, not R32_SFLOAT
  std::uint32_t frame_index = 0;
};

class VulkanDevice;

class HeadlessVulkan {
 public:
  HeadlessVulkan();
  ~HeadlessVulkan();

  static Status create(const HeadlessOptions& options, HeadlessVulkan* vulkan);

  const VulkanDeviceInfo& info() const;
  // What the validation layers had to say, one line each.
  const std::vector<std::string>& messages() const;

  // As compute() on the CPU: visibility, bent normal and cone angle; `times` may be null.
  // Of several runs the fastest of each pass counts.
  Status run(const DepthField& field, const MethodSettings& settings, const Outputs& outputs,
             HeadlessTimes* times = nullptr, const HeadlessFrame& frame = {}, int runs = 1);

  // As light() on the CPU; `ms`, which may be null, becomes the time on the device.
  Status light(const LightingInputs& inputs, const PreconvolvedEnvironment& environment,
               const LightingSettings& settings, const VectorView<float>& out,
               double* ms = nullptr);

  // Bytes per second that a copy within the device's memory reads and writes.
  Status copy_bandwidth(double* bytes_per_second);

 private:
  std::unique_ptr<VulkanDevice> device_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_DEVICE_HEADLESS_H_
