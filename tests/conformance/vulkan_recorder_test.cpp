// The recorder's edge on a live device, with the validation layers on: calls in a wrong order or
// with wrong values are refused, and nothing is leaked or raced for.
#include <gtest/gtest.h>
#include <volk.h>

#include "device/resources.h"
#include "device/transfer.h"
#include "device/vulkan_device.h"
#include "obscura/vulkan.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

constexpr int kWidth = 40, kHeight = 30;

class VulkanRecorder : public testing::Test {
 protected:
  void SetUp() override {
    const Status s = device_.create({.validate = true});
    ASSERT_TRUE(s.ok()) << s.message();
    Random random(3);
    input_ = synthetic::blocks(kWidth, kHeight,
                               synthetic::random_camera(kWidth, kHeight, false, &random), 7);
  }
  void TearDown() override {
    for (const std::string& message : device_.messages()) ADD_FAILURE() << message;
  }

  vulkan::Device device() const {
    return {device_.device(), vkGetDeviceProcAddr, VK_NULL_HANDLE,
            device_.max_storage_buffer_range()};
  }
  static vulkan::FrameShape shape() { return {.width = kWidth, .height = kHeight, .frames = 1}; }
  vulkan::FrameView view() const { return {.camera = input_.camera}; }

  tools::VulkanDevice device_;
  synthetic::Input input_;
};

constexpr VkBufferUsageFlags kScratchUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

TEST_F(VulkanRecorder, CallsOutOfOrderAreRefused) {
  vulkan::Recorder recorder;
  EXPECT_FALSE(recorder.record(device_.commands(), 0, view()).ok());  // not created
  EXPECT_FALSE(vulkan::Recorder::create(device(), LineSettings{}, shape(), nullptr).ok());
  ASSERT_TRUE(vulkan::Recorder::create(device(), LineSettings{}, shape(), &recorder).ok());
  tools::Resources resources(device_);
  tools::Buffer scratch;
  tools::Input depth;
  tools::Output visibility;
  ASSERT_TRUE(resources.buffer(recorder.scratch_bytes() + 256, kScratchUsage, false, &scratch));
  ASSERT_TRUE(resources.input(kWidth, kHeight, VK_FORMAT_R32_SFLOAT, &depth));
  ASSERT_TRUE(resources.output(kWidth, kHeight, tools::VulkanFormat::kR32F, 1, &visibility));
  const vulkan::FrameImages images{.depth = depth.picture.view,
                                   .visibility = visibility.picture.view};
  auto refused = [](const Status& s, const char* part) {
    EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
    EXPECT_NE(s.message().find(part), std::string::npos) << s.message();
  };
  device_.begin();
  recorder.record_tables(device_.commands());  // without scratch memory: nothing
  refused(recorder.bind_images(0, images), "scratch memory must be bound");
  recorder.bind_scratch({scratch.buffer, 12});
  refused(recorder.bind_images(0, images), "offset is 12");
  recorder.bind_scratch({scratch.buffer, 256});
  refused(recorder.bind_images(1, images), "frame is 1");
  refused(recorder.bind_images(-1, images), "frame is -1");
  refused(recorder.bind_images(0, {.depth = depth.picture.view}), "visibility");
  refused(recorder.record(device_.commands(), 0, view()), "has no images");
  ASSERT_TRUE(recorder.bind_images(0, images).ok());
  refused(recorder.record(device_.commands(), 7, view()), "frame is 7");
  ASSERT_TRUE(device_.submit().ok());
}

TEST_F(VulkanRecorder, ManyAreMadeAndGone) {
  // With a cache: compiling is the driver's matter.
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  vulkan::Device cached = device();
  ASSERT_EQ(vkCreatePipelineCache(cached.device, &info, nullptr, &cached.pipeline_cache),
            VK_SUCCESS);
  for (int i = 0; i < 200; ++i) {
    vulkan::Recorder recorder;
    EXPECT_TRUE(vulkan::Recorder::create(cached, LineSettings{}, shape(), &recorder).ok()) << i;
  }
  vkDestroyPipelineCache(cached.device, cached.pipeline_cache, nullptr);
}

// Two estimators use one scratch memory, one after the other in one command buffer: both give what
// they give alone.
TEST_F(VulkanRecorder, TwoShareScratchMemory) {
  vulkan::Recorder recorders[2];
  const MethodSettings methods[2] = {LineSettings{}, HorizonSettings{}};
  VkDeviceSize bytes = 0;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(vulkan::Recorder::create(device(), methods[i], shape(), &recorders[i]).ok());
    bytes = std::max(bytes, recorders[i].scratch_bytes());
  }
  tools::Resources resources(device_);
  tools::Buffer scratch;
  tools::Input depth;
  tools::Output visibility[2];
  ASSERT_TRUE(resources.buffer(bytes, kScratchUsage, false, &scratch));
  ASSERT_TRUE(resources.input(kWidth, kHeight, VK_FORMAT_R32_SFLOAT, &depth));
  tools::fill(input_.field().depth, depth.upload);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(resources.output(kWidth, kHeight, tools::VulkanFormat::kR32F, 1, &visibility[i]));
    recorders[i].bind_scratch({scratch.buffer, 0});
    ASSERT_TRUE(
        recorders[i]
            .bind_images(0, {.depth = depth.picture.view, .visibility = visibility[i].picture.view})
            .ok());
  }
  device_.begin();
  tools::upload(device_.commands(), depth);
  for (int i = 0; i < 2; ++i) {
    tools::make_writable(device_.commands(), visibility[i]);
    recorders[i].record_tables(device_.commands());
    ASSERT_TRUE(recorders[i].record(device_.commands(), 0, view()).ok());
  }
  for (const tools::Output& output : visibility) tools::fetch(device_.commands(), output);
  ASSERT_TRUE(device_.submit().ok());
  for (int i = 0; i < 2; ++i) {
    std::vector<float> gpu(kWidth * kHeight), cpu(gpu.size());
    tools::read(visibility[i], 0, 1, 0, {gpu.data(), kWidth, kHeight});
    ASSERT_TRUE(
        compute(input_.field(), methods[i], {.visibility = {cpu.data(), kWidth, kHeight}}).ok());
    double sum = 0;
    for (std::size_t k = 0; k < cpu.size(); ++k) sum += std::abs(double{cpu[k]} - gpu[k]);
    EXPECT_LT(sum / static_cast<double>(cpu.size()), 1e-3) << i;
  }
}

}  // namespace
}  // namespace obscura
