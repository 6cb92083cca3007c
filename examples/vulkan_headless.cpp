// Obscura on a Vulkan device of one's own, without a window: depth in, ambient visibility out.
//   example_vulkan_headless DEPTH VISIBILITY      (.pfm, .exr of one channel; .png to look at)
// Depth is linear, inf where there is nothing; the camera sees 1 radian from top to bottom. Most of
// this is what any renderer has already; Obscura's part is (1) to (6). docs/vulkan.md says more.
#include <volk.h>
// After volk.h, which says how Vulkan's functions are declared.
#include <obscura/vulkan.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "io/images/files.h"

namespace {

void require(bool good, const std::string& what) {
  if (good) return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}
void require(const obscura::Status& status) { require(status.ok(), status.message()); }
void require(VkResult result, const char* call) {
  require(result == VK_SUCCESS, std::string(call) + " failed: " + std::to_string(result));
}

template <class T>
T make(VkStructureType type) {  // Vulkan's structs begin with their type
  T info{};
  info.sType = type;
  return info;
}

// Kept to the process's end, as all here; a renderer destroys its Recorders before the device.
struct Gpu {
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
};

Gpu make_gpu() {
  Gpu gpu;
  require(volkInitialize(), "looking for libvulkan.so.1");
  auto app = make<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  app.apiVersion = VK_API_VERSION_1_1;
  auto info = make<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &app;
  VkInstance instance;
  require(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
  volkLoadInstance(instance);
  std::uint32_t count = 1;  // the first device will do
  vkEnumeratePhysicalDevices(instance, &count, &gpu.physical);
  require(count == 1, "there is no Vulkan driver on this machine");

  // (1) A queue that computes (by custom the first family does everything), and one feature.
  VkPhysicalDeviceFeatures features{};
  features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue{
      VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, 0, 1, &priority};
  auto device = make<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  device.queueCreateInfoCount = 1;
  device.pQueueCreateInfos = &queue;
  device.pEnabledFeatures = &features;
  require(vkCreateDevice(gpu.physical, &device, nullptr, &gpu.device), "vkCreateDevice");
  volkLoadDevice(gpu.device);
  vkGetDeviceQueue(gpu.device, 0, 0, &gpu.queue);
  VkCommandPool pool;
  const auto pools = make<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  require(vkCreateCommandPool(gpu.device, &pools, nullptr, &pool), "vkCreateCommandPool");
  const VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  require(vkAllocateCommandBuffers(gpu.device, &commands, &gpu.commands), "a command buffer");
  return gpu;
}

VkDeviceMemory allocate(const Gpu& gpu, const VkMemoryRequirements& needs, bool host) {
  const VkMemoryPropertyFlags flags =
      host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
           : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  VkPhysicalDeviceMemoryProperties has;
  vkGetPhysicalDeviceMemoryProperties(gpu.physical, &has);
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, 0};
  std::uint32_t& i = info.memoryTypeIndex;
  while (!(needs.memoryTypeBits >> i & 1) || (has.memoryTypes[i].propertyFlags & flags) != flags) {
    require(++i < has.memoryTypeCount, "no memory of the kind wanted");
  }
  VkDeviceMemory memory;
  require(vkAllocateMemory(gpu.device, &info, nullptr, &memory), "vkAllocateMemory");
  return memory;
}

// Mapped, if `mapped` is there; else the device's own.
VkBuffer make_buffer(const Gpu& gpu, VkDeviceSize bytes, void** mapped) {
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer;
  require(vkCreateBuffer(gpu.device, &info, nullptr, &buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(gpu.device, buffer, &needs);
  const VkDeviceMemory memory = allocate(gpu, needs, mapped);
  require(vkBindBufferMemory(gpu.device, buffer, memory, 0), "vkBindBufferMemory");
  if (mapped) require(vkMapMemory(gpu.device, memory, 0, bytes, 0, mapped), "vkMapMemory");
  return buffer;
}

VkImageView make_image(const Gpu& gpu, VkExtent3D size, VkImage* image) {
  auto info = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = VK_FORMAT_R32_SFLOAT;
  info.extent = size;
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
               VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  require(vkCreateImage(gpu.device, &info, nullptr, image), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(gpu.device, *image, &needs);
  require(vkBindImageMemory(gpu.device, *image, allocate(gpu, needs, false), 0), "an image");
  auto whole = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  whole.image = *image;
  whole.viewType = VK_IMAGE_VIEW_TYPE_2D;
  whole.format = info.format;
  whole.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageView view;
  require(vkCreateImageView(gpu.device, &whole, nullptr, &view), "vkCreateImageView");
  return view;
}

// A renderer names stages and accesses (docs/vulkan.md has Obscura's), so that less waits.
void barrier(const Gpu& gpu, VkImage image, VkImageLayout from, VkImageLayout to) {
  constexpr VkAccessFlags kAny = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  constexpr VkPipelineStageFlags kAll = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
  const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, kAny, kAny};
  auto move = make<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  move.oldLayout = from;
  move.newLayout = to;
  move.image = image;
  move.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(gpu.commands, kAll, kAll | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory, 0,
                       nullptr, 1, &move);
}

}  // namespace

int main(int argc, char** argv) {
  require(argc == 3, "usage: example_vulkan_headless DEPTH VISIBILITY");
  obscura::tools::Image picture;
  require(obscura::tools::read_image(argv[1], &picture));
  const int width = picture.width, height = picture.height;
  std::vector<float>& pixels = picture.channels[0].values;
  const Gpu gpu = make_gpu();

  // (2) Pipelines, once for each setting and size; here of line samples with their blur.
  obscura::LineSettings settings;
  settings.falloff.radius = 0.5f;
  obscura::vulkan::Recorder recorder;
  require(obscura::vulkan::Recorder::create(
      {.device = gpu.device, .get_device_proc_addr = vkGetDeviceProcAddr}, settings,
      {.width = width, .height = height, .frames = 1}, &recorder));

  // (3) Images, and memory for what its passes hand on.
  const VkExtent3D size{std::uint32_t(width), std::uint32_t(height), 1};
  VkImage in, out;
  recorder.bind_scratch({make_buffer(gpu, recorder.scratch_bytes(), nullptr)});
  require(recorder.bind_images(
      0, {.depth = make_image(gpu, size, &in), .visibility = make_image(gpu, size, &out)}));
  void* mapped;
  const VkDeviceSize bytes = pixels.size() * sizeof(float);
  const VkBuffer host = make_buffer(gpu, bytes, &mapped);
  std::memcpy(mapped, pixels.data(), bytes);
  const auto begin = make<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  require(vkBeginCommandBuffer(gpu.commands, &begin), "vkBeginCommandBuffer");
  constexpr VkImageLayout kTo = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  const VkBufferImageCopy copy{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, size};
  barrier(gpu, in, VK_IMAGE_LAYOUT_UNDEFINED, kTo);  // in a renderer the depth pass is here
  vkCmdCopyBufferToImage(gpu.commands, host, in, kTo, 1, &copy);
  // (4) Depth becomes visible to shaders.
  barrier(gpu, in, kTo, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  barrier(gpu, out, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
  // (5) Tables once, the passes in every frame; nothing is allocated, submitted or waited for.
  recorder.record_tables(gpu.commands);
  require(
      recorder.record(gpu.commands, 0, {.camera = obscura::Camera::perspective(1, width, height)}));
  // (6) Visibility becomes visible to its reader: here a copy, in a renderer the lighting.
  barrier(gpu, out, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL);
  vkCmdCopyImageToBuffer(gpu.commands, out, VK_IMAGE_LAYOUT_GENERAL, host, 1, &copy);
  barrier(gpu, out, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL);
  require(vkEndCommandBuffer(gpu.commands), "vkEndCommandBuffer");
  auto submit = make<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &gpu.commands;
  require(vkQueueSubmit(gpu.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  require(vkQueueWaitIdle(gpu.queue), "vkQueueWaitIdle");
  std::memcpy(pixels.data(), mapped, bytes);
  require(obscura::tools::write_image(argv[2], picture));
}
