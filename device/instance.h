#ifndef OBSCURA_DEVICE_INSTANCE_H_
#define OBSCURA_DEVICE_INSTANCE_H_

#include <volk.h>

#include <string>
#include <vector>

#include "device/headless.h"

namespace obscura::tools {

// An instance, with the validation layers if they are wanted; they write to `messages`, which must
// outlive it.
Status make_instance(bool validate, std::vector<std::string>* messages, VkInstance* instance);

// At least one, or refused.
Status physical_devices(VkInstance instance, std::vector<VkPhysicalDevice>* devices);
VulkanDeviceInfo describe(VkPhysicalDevice device);

// The error of a call that failed.
Status failed(const char* call, VkResult result);

}  // namespace obscura::tools

#endif  // OBSCURA_DEVICE_INSTANCE_H_
