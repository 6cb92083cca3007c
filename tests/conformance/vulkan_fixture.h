#ifndef OBSCURA_TESTS_CONFORMANCE_VULKAN_FIXTURE_H_
#define OBSCURA_TESTS_CONFORMANCE_VULKAN_FIXTURE_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "device/headless.h"
#include "tests/property/synthetic.h"

namespace obscura {

// Compares Vulkan with the CPU, with the validation layers on. A missing driver is a failure: the
// tests' packages include a software driver.
class VulkanTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    vulkan_ = new tools::HeadlessVulkan;
    status_ = tools::HeadlessVulkan::create({.validate = true}, vulkan_);
  }
  static void TearDownTestSuite() { delete vulkan_; }
  void SetUp() override { ASSERT_TRUE(status_.ok()) << status_.message(); }

  // Mean difference at most 0.1 %, 99.9 % of the pixels (`close_share_`) within 1/255. `step` is
  // what lies between two values that the format can hold, where that is more than it is for
  // visibility.
  static void expect_close(std::span<const float> cpu, std::span<const float> gpu,
                           const std::string& what, double step = 0) {
    double sum = 0;
    std::size_t close = 0;
    for (std::size_t i = 0; i < cpu.size(); ++i) {
      const double difference = std::abs(double{cpu[i]} - gpu[i]);
      sum += difference;
      close += difference <= 1.0 / 255 + step / 2;
    }
    EXPECT_LE(sum / cpu.size(), 0.001 + step / 4) << what;
    EXPECT_GE(double(close), close_share_ * cpu.size()) << what;
  }

  // Compares every output, and expects no message from the layers. Directions are compared where at
  // least 0.02 of the sphere is visible, as shorter ones have no reliable direction.
  static void expect_same(const DepthField& field, const MethodSettings& settings,
                          const std::string& what, bool directions = false,
                          const tools::HeadlessFrame& frame = {}) {
    const int w = field.visible().width, h = field.visible().height;
    std::vector<float> images[2][5];
    Outputs outputs[2];
    for (int i = 0; i < 2; ++i) {
      std::array<ImageView<float>, 5> views;
      for (int c = 0; c < (directions ? 5 : 1); ++c) {
        images[i][c].assign(std::size_t(w) * h, -1.0f);
        views[c] = {images[i][c].data(), w, h};
      }
      outputs[i] = {.visibility = views[0],
                    .bent_normal = {views[1], views[2], views[3]},
                    .cone_angle = views[4]};
    }
    const Status on_cpu = compute(field, settings, outputs[0]);
    ASSERT_TRUE(on_cpu.ok()) << what << ": " << on_cpu.message();
    tools::HeadlessTimes times;
    const Status on_gpu = vulkan_->run(field, settings, outputs[1], &times, frame);
    ASSERT_TRUE(on_gpu.ok()) << what << ": " << on_gpu.message();
    constexpr const char* kNames[] = {"visibility", "bent x", "bent y", "bent z", "cone"};
    for (int c = 0; c < (directions ? 5 : 1); ++c) {
      for (int i = 0; c > 0 && i < 2; ++i) {
        for (std::size_t k = 0; k < images[i][c].size(); ++k) {
          if (images[0][0][k] < 0.02f) images[i][c][k] = 0;
        }
      }
      const bool coarse = c > 0 && frame.output == tools::VulkanFormat::kR8;
      const double step = !coarse ? 0 : (c == 4 ? 1.57079633 : 2.0) / 255;
      expect_close(images[0][c], images[1][c], what + ", " + kNames[c], step);
    }
    EXPECT_FALSE(times.passes.empty());
    for (const std::string& message : vulkan_->messages()) ADD_FAILURE() << what << ": " << message;
  }

  // Random patterns change with the frame.
  static void expect_frames_differ(const DepthField& field, const MethodSettings& settings) {
    const int w = field.visible().width, h = field.visible().height;
    std::vector<float> frames[2];
    for (std::uint32_t i = 0; i < 2; ++i) {
      frames[i].resize(std::size_t(w) * h);
      const Status s = vulkan_->run(field, settings, {.visibility = {frames[i].data(), w, h}},
                                    nullptr, {.frame_index = i});
      ASSERT_TRUE(s.ok()) << s.message();
    }
    EXPECT_NE(frames[0], frames[1]);
  }

  static inline tools::HeadlessVulkan* vulkan_ = nullptr;
  static inline Status status_;
  static inline double close_share_ = 0.999;
};

}  // namespace obscura

#endif  // OBSCURA_TESTS_CONFORMANCE_VULKAN_FIXTURE_H_
