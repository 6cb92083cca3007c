#include "device/vulkan_device.h"

#include "device/instance.h"
#include "fmt/format.h"

namespace obscura::tools {

VulkanDevice::~VulkanDevice() {
  if (device_) {
    vkDestroyQueryPool(device_, queries_, nullptr);
    vkDestroyFence(device_, fence_, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (instance_) vkDestroyInstance(instance_, nullptr);
}

Status VulkanDevice::create(const HeadlessOptions& options) {
  if (Status s = make_instance(options.validate, &messages_, &instance_); !s.ok()) return s;
  std::vector<VkPhysicalDevice> devices;
  if (Status s = physical_devices(instance_, &devices); !s.ok()) return s;
  if (options.device >= static_cast<int>(devices.size())) {
    return invalid_argument(fmt::format("device is {}; this machine has devices 0 to {}",
                                        options.device, devices.size() - 1));
  }
  std::size_t chosen = 0;
  while (chosen + 1 < devices.size() && describe(devices[chosen]).software) ++chosen;
  if (describe(devices[chosen]).software) chosen = 0;
  if (options.device >= 0) chosen = static_cast<std::size_t>(options.device);
  physical_ = devices[chosen];
  info_ = describe(physical_);
  return make_device();
}

Status VulkanDevice::make_device() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  std::uint32_t family = 0;
  while (family < count && !(families[family].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++family;
  VkPhysicalDeviceFeatures has;
  vkGetPhysicalDeviceFeatures(physical_, &has);
  if (family == count || !has.shaderStorageImageWriteWithoutFormat) {
    return {StatusCode::kUnsupported,
            fmt::format("{} has no compute queue or no shaderStorageImageWriteWithoutFormat",
                        info_.name)};
  }
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceFeatures features{};
  features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.pEnabledFeatures = &features;
  if (VkResult result = vkCreateDevice(physical_, &info, nullptr, &device_); result != VK_SUCCESS) {
    return failed("vkCreateDevice", result);
  }
  vkGetDeviceQueue(device_, family, 0, &queue_);
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  tick_ns_ = properties.limits.timestampPeriod;
  max_storage_buffer_range_ = properties.limits.maxStorageBufferRange;
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = family;
  vkCreateCommandPool(device_, &pool, nullptr, &pool_);
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  vkCreateFence(device_, &fence, nullptr, &fence_);
  VkQueryPoolCreateInfo queries{};
  queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = kQueries;
  vkCreateQueryPool(device_, &queries, nullptr, &queries_);
  VkCommandBufferAllocateInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  commands.commandPool = pool_;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  if (!pool_ || !fence_ || !queries_ ||
      vkAllocateCommandBuffers(device_, &commands, &commands_) != VK_SUCCESS) {
    return {StatusCode::kOutOfMemory, "out of memory on the Vulkan device"};
  }
  return {};
}

bool VulkanDevice::allocate(const VkMemoryRequirements& needs, bool host,
                            VkDeviceMemory* memory) const {
  const VkMemoryPropertyFlags wanted =
      host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
           : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    if (!(needs.memoryTypeBits & (1u << i)) ||
        (memory_.memoryTypes[i].propertyFlags & wanted) != wanted) {
      continue;
    }
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs.size;
    info.memoryTypeIndex = i;
    return vkAllocateMemory(device_, &info, nullptr, memory) == VK_SUCCESS;
  }
  return false;
}

void VulkanDevice::begin() const {
  vkResetCommandPool(device_, pool_, 0);
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  vkBeginCommandBuffer(commands_, &info);
}

Status VulkanDevice::submit() const {
  if (VkResult r = vkEndCommandBuffer(commands_); r != VK_SUCCESS) {
    return failed("vkEndCommandBuffer", r);
  }
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands_;
  if (VkResult r = vkQueueSubmit(queue_, 1, &info, fence_); r != VK_SUCCESS) {
    return failed("vkQueueSubmit", r);
  }
  const VkResult r = vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX);
  vkResetFences(device_, 1, &fence_);
  return r == VK_SUCCESS ? Status() : failed("vkWaitForFences", r);
}

double VulkanDevice::ms_between(std::uint32_t first, std::uint32_t second) const {
  std::uint64_t ticks[2] = {};
  for (int i = 0; i < 2; ++i) {
    vkGetQueryPoolResults(device_, queries_, i == 0 ? first : second, 1, sizeof(ticks[i]),
                          &ticks[i], sizeof(ticks[i]),
                          VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  }
  return static_cast<double>(ticks[1] - ticks[0]) * tick_ns_ * 1e-6;
}

}  // namespace obscura::tools
