#include "tests/conformance/vulkan_fixture.h"
#include "tests/property/backdrop.h"

namespace obscura {
namespace {

using VulkanBackdrop = VulkanTest;
using namespace synthetic;

// On the device, too, how deep a backdrop is does not matter to what stands before it.
TEST_F(VulkanBackdrop, MovesNothingBeforeItByAnyMethod) {
  auto visibility = [&](const Input& in, const MethodSettings& settings) {
    std::vector<float> v(in.depth.size());
    const Status s = vulkan_->run(in.field(), settings,
                                  {.visibility = {v.data(), in.width, in.height}}, nullptr, {});
    EXPECT_TRUE(s.ok()) << s.message();
    return v;
  };
  for (const MethodSettings& settings : default_methods()) {
    if (method_name(settings) == "ray-traced") continue;  // on the CPU only
    for_each_backdrop({34, 1e8}, [&](const std::string& what, const Input& in, const Input& open) {
      EXPECT_LE(moved(open, visibility(in, settings), visibility(open, settings)), kUnmoved)
          << method_name(settings) << ", " << what;
    });
  }
}

}  // namespace
}  // namespace obscura
