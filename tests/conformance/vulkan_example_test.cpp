#include <cstdlib>
#include <filesystem>

#include "io/images/files.h"
#include "paths.h"
#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanExample = VulkanTest;

// examples/vulkan_headless.cpp gives the same result as the CPU with the same settings.
TEST_F(VulkanExample, GivesWhatTheProcessorGives) {
  constexpr int kWidth = 96, kHeight = 64;
  const Camera camera = Camera::perspective(1, kWidth, kHeight);
  const synthetic::Input in = synthetic::blocks(kWidth, kHeight, camera, 3);
  std::string folder = (std::filesystem::temp_directory_path() / "obscura-XXXXXX").string();
  ASSERT_TRUE(mkdtemp(folder.data()));
  tools::Image depth(kWidth, kHeight), result;
  depth.add("Z") = in.depth;
  ASSERT_TRUE(tools::write_image(folder + "/depth.pfm", depth).ok());
  const std::string command =
      "cd '" + folder + "'; '" OBSCURA_VULKAN_EXAMPLE "' depth.pfm visibility.pfm";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const Status read = tools::read_image(folder + "/visibility.pfm", &result);
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(read.ok()) << read.message();

  std::vector<float> cpu(in.depth.size());
  LineSettings settings;
  settings.falloff.radius = 0.5f;
  ASSERT_TRUE(compute(in.field(), settings, {.visibility = {cpu.data(), kWidth, kHeight}}).ok());
  expect_close(cpu, result.channels[0].values, "example");
}

}  // namespace
}  // namespace obscura
