#include <cmath>

#include "io/images/files.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

class BackendTest : public CommandTest {};

// Vulkan drivers keep memory to the end.
constexpr const char* kDriversLeak = "export ASAN_OPTIONS=detect_leaks=0;";

constexpr const char* kPlane =
    "ao scene:cornell --size 48x36 --method line --no-blur --radius 0.5 ";

TEST_F(BackendTest, VulkanGivesWhatTheProcessorGives) {
#ifndef OBSCURA_WITH_VULKAN
  GTEST_SKIP() << "built without Vulkan";
#endif
  ASSERT_EQ(run(std::string(kPlane) + "-o cpu.pfm").code, 0);
  const CommandResult r =
      run(std::string(kPlane) + "--backend vulkan --json times.json -o gpu.pfm", kDriversLeak);
  ASSERT_EQ(r.code, 0) << r.err;
  tools::Image cpu, gpu;
  ASSERT_TRUE(tools::read_image(path("cpu.pfm"), &cpu).ok());
  ASSERT_TRUE(tools::read_image(path("gpu.pfm"), &gpu).ok());
  double sum = 0;
  for (std::size_t i = 0; i < cpu.channels[0].values.size(); ++i) {
    sum += std::abs(cpu.channels[0].values[i] - gpu.channels[0].values[i]);
  }
  EXPECT_LT(sum / cpu.channels[0].values.size(), 0.001);
  EXPECT_EQ(run("info --devices", kDriversLeak).code, 0);
  // Without a GPU, and for methods that do not run on it, auto uses the CPU.
  EXPECT_EQ(run("ao scene:cornell --size 16x12 --backend auto -o a.pfm", kDriversLeak).code, 0);
}

TEST_F(BackendTest, WrongUseIsTold) {
  const std::string plane = kPlane;
  expect_failure(plane + "--backend gpu -o a.pfm", 2, "--backend is 'gpu'");
  expect_failure(plane + "--device 0 -o a.pfm", 2, "--device belongs to");
  expect_failure("info", 2, "FILE is missing");
#ifdef OBSCURA_WITH_VULKAN
  expect_failure(plane + "--backend vulkan --device 99 -o a.pfm", 2, "device is 99", kDriversLeak);
  expect_failure("ao scene:cornell --size 16x12 --method ray-traced --backend vulkan -o a.pfm", 2,
                 "does not run on Vulkan", kDriversLeak);
#endif
}

}  // namespace
}  // namespace obscura
