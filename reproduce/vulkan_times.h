#ifndef OBSCURA_REPRODUCE_VULKAN_TIMES_H_
#define OBSCURA_REPRODUCE_VULKAN_TIMES_H_

#include "reproduce/reproduce.h"

namespace obscura::tools {

// The papers' timing tables at their resolutions on the first Vulkan device, pass by pass, beside
// their own figures.
Status reproduce_vulkan_times(const ReproduceContext& context, Report* report, std::string* text);

// The far field's presets against mipmap at equal time on the first Vulkan device.
Status reproduce_vulkan_bars(const ReproduceContext& context, Report* report, std::string* text);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_VULKAN_TIMES_H_
