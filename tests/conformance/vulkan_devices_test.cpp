#include <gtest/gtest.h>

#include "device/headless.h"

namespace obscura {
namespace {

TEST(VulkanDevices, AreListed) {
  std::vector<tools::VulkanDeviceInfo> devices;
  const Status s = tools::list_vulkan_devices(&devices);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_FALSE(devices.front().name.empty());
}

}  // namespace
}  // namespace obscura
