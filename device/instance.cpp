#define VOLK_IMPLEMENTATION
#include "device/instance.h"

#include "fmt/format.h"

namespace obscura::tools {
namespace {

constexpr const char* kValidation = "VK_LAYER_KHRONOS_validation";

VkBool32 VKAPI_PTR keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                VkDebugUtilsMessageTypeFlagsEXT,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->push_back(data->pMessage);
  return VK_FALSE;
}

}  // namespace

Status failed(const char* call, VkResult result) {
  return {StatusCode::kUnsupported,
          fmt::format("{} failed on the Vulkan device ({})", call, static_cast<int>(result))};
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
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return {
        StatusCode::kUnsupported,
        "there is no Vulkan driver on this machine; install the graphics card's, or the package "
        "mesa-vulkan-drivers"};
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

}  // namespace obscura::tools
