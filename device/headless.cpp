#define VOLK_IMPLEMENTATION
#include "device/headless.h"

#include <volk.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "fmt/format.h"
#include "obscura/vulkan.h"

namespace obscura::tools {
namespace {

constexpr const char* kValidation = "VK_LAYER_KHRONOS_validation";

Status failed(const char* call, VkResult result) {
  return {StatusCode::kUnsupported,
          fmt::format("{} failed on the Vulkan device ({})", call, static_cast<int>(result))};
}

VkBool32 VKAPI_PTR keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                VkDebugUtilsMessageTypeFlagsEXT,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
  return VK_FALSE;
}

VulkanDeviceInfo describe(VkPhysicalDevice device) {
  VkPhysicalDeviceVulkan12Properties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &properties);
  return {properties.properties.deviceName,
          fmt::format("{} {}", driver.driverName, driver.driverInfo),
          properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU};
}

Status make_instance(bool validate, std::vector<std::string>* messages, VkInstance* instance) {
  if (volkInitialize() != VK_SUCCESS) {
    return {StatusCode::kUnsupported, "there is no Vulkan loader (libvulkan.so.1) on this machine"};
  }
  VkApplicationInfo app{};
  app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  app.pApplicationName = "obscura";
  app.apiVersion = VK_API_VERSION_1_2;
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = keep_message;
  messenger.pUserData = messages;
  const VkValidationFeatureEnableEXT enabled[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enabled;
  const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &app;
  if (validate) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidation;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = extensions;
  }
  const VkResult result = vkCreateInstance(&info, nullptr, instance);
  if (result == VK_ERROR_LAYER_NOT_PRESENT) {
    return {StatusCode::kUnsupported, fmt::format("the layer {} is not installed", kValidation)};
  }
  if (result != VK_SUCCESS) return failed("vkCreateInstance", result);
  volkLoadInstance(*instance);
  return {};
}

Status physical_devices(VkInstance instance, std::vector<VkPhysicalDevice>* devices) {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  devices->resize(count);
  if (count > 0) vkEnumeratePhysicalDevices(instance, &count, devices->data());
  if (count == 0) {
    return {StatusCode::kUnsupported,
            "there is no Vulkan driver on this machine (mesa-vulkan-drivers has a software one)"};
  }
  return {};
}

}  // namespace

Status list_vulkan_devices(std::vector<VulkanDeviceInfo>* devices) {
  VkInstance instance = VK_NULL_HANDLE;
  if (Status s = make_instance(false, nullptr, &instance); !s.ok()) return s;
  std::vector<VkPhysicalDevice> physical;
  const Status status = physical_devices(instance, &physical);
  devices->clear();
  for (VkPhysicalDevice d : physical) devices->push_back(describe(d));
  vkDestroyInstance(instance, nullptr);
  return status;
}

class HeadlessVulkan::Impl {
 public:
  ~Impl() {
    if (device_) {
      vkDestroyQueryPool(device_, queries_, nullptr);
      vkDestroyFence(device_, fence_, nullptr);
      vkDestroyCommandPool(device_, pool_, nullptr);
      vkDestroyDevice(device_, nullptr);
    }
    if (instance_) vkDestroyInstance(instance_, nullptr);
  }

  Status create(const HeadlessOptions& options) {
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

  const VulkanDeviceInfo& info() const { return info_; }
  const std::vector<std::string>& messages() const { return messages_; }

  Status run(const DepthField& field, const MethodSettings& settings, const Outputs& outputs,
             HeadlessTimes* times, const HeadlessFrame& frame, int runs) {
    if (Status s = check(outputs); !s.ok()) return s;
    const int width = field.visible().width, height = field.visible().height;
    const bool directions = !outputs.bent_normal.empty() || !outputs.cone_angle.empty();
    const vulkan::FrameShape shape{.width = field.depth.width,
                                   .height = field.depth.height,
                                   .guard_band = field.guard_band,
                                   .depth_kind = field.depth_kind,
                                   .normals = !field.normals.empty(),
                                   .normal_use = field.normal_use,
                                   .back_depth = !field.back_depth.empty(),
                                   .directions = !directions ? vulkan::Directions::kNone
                                                 : frame.output == VulkanFormat::kR8
                                                     ? vulkan::Directions::kUnsigned
                                                     : vulkan::Directions::kSigned,
                                   .frames = 1};
    vulkan::Recorder recorder;
    if (Status s = vulkan::Recorder::create(
            {device_, vkGetDeviceProcAddr, VK_NULL_HANDLE, max_storage_buffer_range_}, settings,
            shape, &recorder);
        !s.ok()) {
      return s;
    }
    if (recorder.pass_names().size() >= kQueries) return unsupported("too many passes to time");
    Resources r(*this);
    Buffer scratch;
    Input depth, normals, back_depth;
    Output visibility, bent_normal;
    const bool ok =
        r.buffer(recorder.scratch_bytes(),
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false,
                 &scratch) &&
        r.input(shape.width, shape.height,
                frame.depth_buffer ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R32_SFLOAT, &depth) &&
        (!shape.back_depth ||
         r.input(shape.width, shape.height, VK_FORMAT_R32_SFLOAT, &back_depth)) &&
        (!shape.normals ||
         r.input(shape.width, shape.height, VK_FORMAT_R32G32B32A32_SFLOAT, &normals)) &&
        r.output(width, height, frame.output, 1, &visibility) &&
        (!directions || r.output(width, height, frame.output, 4, &bent_normal));
    if (!ok) return {StatusCode::kOutOfMemory, "out of memory on the Vulkan device"};
    fill(field.depth, depth.upload);
    if (shape.normals) fill(field.normals, normals.upload);
    if (shape.back_depth) fill(field.back_depth, back_depth.upload);
    recorder.bind_scratch({scratch.buffer, 0});
    if (Status s = recorder.bind_images(
            0, {depth.picture.view, normals.picture.view, visibility.picture.view,
                bent_normal.picture.view, back_depth.picture.view});
        !s.ok()) {
      return s;
    }
    for (int i = 0; i < runs; ++i) {
      begin();
      upload(depth);
      if (shape.normals) upload(normals);
      if (shape.back_depth) upload(back_depth);
      make_writable(visibility);
      if (directions) make_writable(bent_normal);
      recorder.record_tables(commands_);
      vkCmdResetQueryPool(commands_, queries_, 0, kQueries);
      const auto start = std::chrono::steady_clock::now();
      const Status status = recorder.record(
          commands_, 0, {field.camera, field.near_plane, field.far_plane, frame.frame_index},
          {.timestamps = queries_, .first_query = 0});
      const std::chrono::duration<double, std::micro> recorded =
          std::chrono::steady_clock::now() - start;
      fetch(visibility);
      if (directions) fetch(bent_normal);
      if (Status s = submit(); !s.ok()) return s;
      if (!status.ok()) return status;
      if (times) report(recorder, recorded.count(), i == 0, times);
    }
    read(visibility, 0, 1, 0, outputs.visibility);
    const bool unsigned_range = frame.output == VulkanFormat::kR8;
    const ImageView<float>* vector[] = {&outputs.bent_normal.x, &outputs.bent_normal.y,
                                        &outputs.bent_normal.z};
    for (int c = 0; c < 3; ++c) {
      read(bent_normal, c, unsigned_range ? 2.0f : 1.0f, unsigned_range ? -1.0f : 0.0f, *vector[c]);
    }
    read(bent_normal, 3, 1.57079633f, 0, outputs.cone_angle);
    return {};
  }

  Status copy_bandwidth(double* bytes_per_second) {
    constexpr VkDeviceSize kBytes = VkDeviceSize{256} << 20;
    Resources r(*this);
    Buffer from, to;
    if (!r.buffer(kBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, false, &from) ||
        !r.buffer(kBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, false, &to)) {
      return {StatusCode::kOutOfMemory, "out of memory on the Vulkan device"};
    }
    *bytes_per_second = 0;
    for (int i = 0; i < 5; ++i) {
      begin();
      vkCmdResetQueryPool(commands_, queries_, 0, 2);
      vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries_, 0);
      const VkBufferCopy copy{0, 0, kBytes};
      vkCmdCopyBuffer(commands_, from.buffer, to.buffer, 1, &copy);
      vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, queries_, 1);
      if (Status s = submit(); !s.ok()) return s;
      std::uint64_t ticks[2];
      vkGetQueryPoolResults(device_, queries_, 0, 2, sizeof(ticks), ticks, sizeof(ticks[0]),
                            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
      const double seconds = static_cast<double>(ticks[1] - ticks[0]) * tick_ns_ * 1e-9;
      if (seconds > 0) *bytes_per_second = std::max(*bytes_per_second, 2.0 * kBytes / seconds);
    }
    return {};
  }

 private:
  static constexpr std::uint32_t kQueries = 1024;

  struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
  };
  struct Picture {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint32_t width = 0, height = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  };
  struct Input {
    Picture picture;
    Buffer upload;
  };
  struct Output {
    Picture picture;
    Buffer download;
    VulkanFormat format = VulkanFormat::kR32F;
    int channels = 1;
  };

  static Status check(const Outputs& o) {
    if (o.visibility.empty()) return invalid_argument("on Vulkan visibility is always written");
    if (!o.uniform_integral.empty() || !o.cosine_integral.empty() || !o.normal.empty() ||
        !o.standard_error.empty() || !o.radiance.empty()) {
      return unsupported("on Vulkan the outputs are visibility, bent-normal and cone-angle");
    }
    return {};
  }

  // What one run makes, gone at its end.
  class Resources {
   public:
    explicit Resources(Impl& impl) : impl_(impl) {}
    ~Resources() {
      for (const Buffer& b : buffers_) {
        vkDestroyBuffer(impl_.device_, b.buffer, nullptr);
        vkFreeMemory(impl_.device_, b.memory, nullptr);
      }
      for (const Picture& p : pictures_) {
        vkDestroyImageView(impl_.device_, p.view, nullptr);
        vkDestroyImage(impl_.device_, p.image, nullptr);
        vkFreeMemory(impl_.device_, p.memory, nullptr);
      }
    }

    bool buffer(VkDeviceSize bytes, VkBufferUsageFlags usage, bool host, Buffer* result) {
      Buffer& b = buffers_.emplace_back();
      VkBufferCreateInfo info{};
      info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
      info.size = bytes;
      info.usage = usage;
      if (vkCreateBuffer(impl_.device_, &info, nullptr, &b.buffer) != VK_SUCCESS) return false;
      VkMemoryRequirements needs;
      vkGetBufferMemoryRequirements(impl_.device_, b.buffer, &needs);
      if (!impl_.allocate(needs, host, &b.memory) ||
          vkBindBufferMemory(impl_.device_, b.buffer, b.memory, 0) != VK_SUCCESS) {
        return false;
      }
      if (host &&
          vkMapMemory(impl_.device_, b.memory, 0, VK_WHOLE_SIZE, 0, &b.mapped) != VK_SUCCESS) {
        return false;
      }
      *result = b;
      return true;
    }

    bool image(int width, int height, VkFormat format, VkImageUsageFlags usage, Picture* result) {
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
      if (vkCreateImage(impl_.device_, &info, nullptr, &p.image) != VK_SUCCESS) return false;
      VkMemoryRequirements needs;
      vkGetImageMemoryRequirements(impl_.device_, p.image, &needs);
      if (!impl_.allocate(needs, false, &p.memory) ||
          vkBindImageMemory(impl_.device_, p.image, p.memory, 0) != VK_SUCCESS) {
        return false;
      }
      VkImageViewCreateInfo view{};
      view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
      view.image = p.image;
      view.viewType = VK_IMAGE_VIEW_TYPE_2D;
      view.format = format;
      view.subresourceRange = {p.aspect, 0, 1, 0, 1};
      if (vkCreateImageView(impl_.device_, &view, nullptr, &p.view) != VK_SUCCESS) return false;
      *result = p;
      return true;
    }

    bool input(int width, int height, VkFormat format, Input* result) {
      const VkDeviceSize texel = format == VK_FORMAT_R32G32B32A32_SFLOAT ? 16 : 4;
      return image(width, height, format,
                   VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                   &result->picture) &&
             buffer(texel * width * height, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true,
                    &result->upload);
    }

    bool output(int width, int height, VulkanFormat format, int channels, Output* result) {
      constexpr VkFormat kFormats[][3] = {
          {VK_FORMAT_R8_UNORM, VK_FORMAT_R16_SFLOAT, VK_FORMAT_R32_SFLOAT},
          {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT}};
      result->format = format;
      result->channels = channels;
      return image(width, height, kFormats[channels == 4][static_cast<int>(format)],
                   VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                   &result->picture) &&
             buffer(static_cast<VkDeviceSize>(4) * channels * width * height,
                    VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, &result->download);
    }

   private:
    Impl& impl_;
    std::vector<Buffer> buffers_;
    std::vector<Picture> pictures_;
  };

  Status make_device() {
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
    if (VkResult result = vkCreateDevice(physical_, &info, nullptr, &device_);
        result != VK_SUCCESS) {
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

  bool allocate(const VkMemoryRequirements& needs, bool host, VkDeviceMemory* memory) const {
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

  static void fill(const ImageView<const float>& image, const Buffer& to) {
    auto* out = static_cast<float*>(to.mapped);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) *out++ = image(x, y);
    }
  }
  static void fill(const VectorView<const float>& image, const Buffer& to) {
    auto* out = static_cast<float*>(to.mapped);
    for (int y = 0; y < image.x.height; ++y) {
      for (int x = 0; x < image.x.width; ++x) {
        for (const auto* view : {&image.x, &image.y, &image.z}) *out++ = (*view)(x, y);
        *out++ = 0;
      }
    }
  }

  void begin() {
    vkResetCommandPool(device_, pool_, 0);
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    vkBeginCommandBuffer(commands_, &info);
  }

  void transition(const Picture& picture, VkImageLayout from, VkImageLayout to,
                  VkPipelineStageFlags before, VkAccessFlags written, VkPipelineStageFlags after,
                  VkAccessFlags used) {
    VkImageMemoryBarrier b{};
    b.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    b.srcAccessMask = written;
    b.dstAccessMask = used;
    b.oldLayout = from;
    b.newLayout = to;
    b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    b.image = picture.image;
    b.subresourceRange = {picture.aspect, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands_, before, after, 0, 0, nullptr, 0, nullptr, 1, &b);
  }

  void upload(const Input& input) {
    const Picture& to = input.picture;
    transition(to, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0, VK_PIPELINE_STAGE_TRANSFER_BIT,
               VK_ACCESS_TRANSFER_WRITE_BIT);
    const VkBufferImageCopy copy = whole(to);
    vkCmdCopyBufferToImage(commands_, input.upload.buffer, to.image,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    transition(to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
               VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
               VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
  }

  void make_writable(const Output& output) {
    transition(output.picture, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL,
               VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
               VK_ACCESS_SHADER_WRITE_BIT);
  }

  void fetch(const Output& output) {
    const Picture& from = output.picture;
    transition(from, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
               VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
    const VkBufferImageCopy copy = whole(from);
    vkCmdCopyImageToBuffer(commands_, from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           output.download.buffer, 1, &copy);
    VkMemoryBarrier b{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                      VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0,
                         1, &b, 0, nullptr, 0, nullptr);
  }

  static VkBufferImageCopy whole(const Picture& p) {
    VkBufferImageCopy copy{};
    copy.imageSubresource = {p.aspect, 0, 0, 1};
    copy.imageExtent = {p.width, p.height, 1};
    return copy;
  }

  Status submit() {
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

  static float from_half(std::uint16_t h) {
    const int exponent = (h >> 10) & 31, mantissa = h & 1023;
    const float value = exponent == 0
                            ? std::ldexp(static_cast<float>(mantissa), -24)
                            : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
    return h & 0x8000 ? -value : value;
  }

  // Channel `c` of an image, scaled and moved, if anybody wants it.
  static void read(const Output& from, int c, float scale, float offset,
                   const ImageView<float>& out) {
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

  // Of this run if it is the first, else where it was faster than those before.
  void report(const vulkan::Recorder& recorder, double record_us, bool first,
              HeadlessTimes* times) const {
    const std::size_t count = recorder.pass_names().size();
    std::vector<std::uint64_t> ticks(count + 1);
    vkGetQueryPoolResults(device_, queries_, 0, static_cast<std::uint32_t>(count + 1),
                          ticks.size() * sizeof(ticks[0]), ticks.data(), sizeof(ticks[0]),
                          VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    HeadlessTimes now{.record_us = record_us};
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view name = recorder.pass_names()[i];
      auto pass = std::ranges::find(now.passes, name, &HeadlessPass::name);
      if (pass == now.passes.end()) {
        pass = now.passes.insert(pass, {.name = recorder.pass_names()[i]});
      }
      pass->ms += static_cast<double>(ticks[i + 1] - ticks[i]) * tick_ns_ * 1e-6;
      pass->bytes += static_cast<double>(recorder.pass_bytes()[i]);
    }
    if (first) {
      *times = now;
      return;
    }
    times->record_us = std::min(times->record_us, now.record_us);
    for (std::size_t i = 0; i < now.passes.size(); ++i) {
      times->passes[i].ms = std::min(times->passes[i].ms, now.passes[i].ms);
    }
  }

  std::vector<std::string> messages_;
  VulkanDeviceInfo info_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  double tick_ns_ = 1;
  std::uint32_t max_storage_buffer_range_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
};

HeadlessVulkan::HeadlessVulkan() = default;
HeadlessVulkan::~HeadlessVulkan() = default;

Status HeadlessVulkan::create(const HeadlessOptions& options, HeadlessVulkan* vulkan) {
  auto impl = std::make_unique<Impl>();
  if (Status s = impl->create(options); !s.ok()) return s;
  vulkan->impl_ = std::move(impl);
  return {};
}
const VulkanDeviceInfo& HeadlessVulkan::info() const { return impl_->info(); }
const std::vector<std::string>& HeadlessVulkan::messages() const { return impl_->messages(); }
Status HeadlessVulkan::run(const DepthField& field, const MethodSettings& settings,
                           const Outputs& outputs, HeadlessTimes* times, const HeadlessFrame& frame,
                           int runs) {
  return impl_->run(field, settings, outputs, times, frame, runs);
}
Status HeadlessVulkan::copy_bandwidth(double* bytes_per_second) {
  return impl_->copy_bandwidth(bytes_per_second);
}

double HeadlessTimes::total_ms() const {
  double sum = 0;
  for (const HeadlessPass& pass : passes) sum += pass.ms;
  return sum;
}

}  // namespace obscura::tools
