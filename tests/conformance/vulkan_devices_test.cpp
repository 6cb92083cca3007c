#include <gtest/gtest.h>

#include "support/vulkan/headless.h"

namespace obscura {
namespace {

TEST(VulkanDevices, AreListed) {
  std::vector<support::VulkanDeviceInfo> devices;
  const Status s = support::list_vulkan_devices(&devices);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_FALSE(devices.front().name.empty());
}

}  // namespace
}  // namespace obscura
