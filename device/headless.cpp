#include "device/headless.h"

#include <algorithm>
#include <chrono>

#include "device/transfer.h"
#include "obscura/vulkan.h"

namespace obscura::tools {
namespace {

Status check(const Outputs& o) {
  if (o.visibility.empty()) return invalid_argument("on Vulkan visibility is always written");
  if (!o.uniform_integral.empty() || !o.cosine_integral.empty() || !o.normal.empty() ||
      !o.standard_error.empty() || !o.radiance.empty()) {
    return unsupported("on Vulkan the outputs are visibility, bent-normal and cone-angle");
  }
  return {};
}

// Of this run if it is the first, else where it was faster than those before.
void report(const VulkanDevice& device, const vulkan::Recorder& recorder, double record_us,
            bool first, HeadlessTimes* times) {
  const std::size_t count = recorder.pass_names().size();
  std::vector<std::uint64_t> ticks(count + 1);
  vkGetQueryPoolResults(device.device(), device.queries(), 0, static_cast<std::uint32_t>(count + 1),
                        ticks.size() * sizeof(ticks[0]), ticks.data(), sizeof(ticks[0]),
                        VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  HeadlessTimes now{.record_us = record_us};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view name = recorder.pass_names()[i];
    auto pass = std::ranges::find(now.passes, name, &HeadlessPass::name);
    if (pass == now.passes.end()) {
      pass = now.passes.insert(pass, {.name = recorder.pass_names()[i]});
    }
    pass->ms += static_cast<double>(ticks[i + 1] - ticks[i]) * device.tick_ns() * 1e-6;
    pass->bytes += static_cast<double>(recorder.pass_bytes()[i]);
  }
  if (first) {
    *times = now;
    return;
  }
  times->record_us = std::min(times->record_us, now.record_us);
  for (std::size_t i = 0; i < now.passes.size(); ++i) {
    times->passes[i].ms = std::min(times->passes[i].ms, now.passes[i].ms);
  }
}

}  // namespace

HeadlessVulkan::HeadlessVulkan() = default;
HeadlessVulkan::~HeadlessVulkan() = default;

Status HeadlessVulkan::create(const HeadlessOptions& options, HeadlessVulkan* vulkan) {
  auto device = std::make_unique<VulkanDevice>();
  if (Status s = device->create(options); !s.ok()) return s;
  vulkan->device_ = std::move(device);
  return {};
}
const VulkanDeviceInfo& HeadlessVulkan::info() const { return device_->info(); }
const std::vector<std::string>& HeadlessVulkan::messages() const { return device_->messages(); }

Status HeadlessVulkan::run(const DepthField& field, const MethodSettings& settings,
                           const Outputs& outputs, HeadlessTimes* times, const HeadlessFrame& frame,
                           int runs) {
  VulkanDevice& device = *device_;
  if (Status s = check(outputs); !s.ok()) return s;
  const int width = field.visible().width, height = field.visible().height;
  const bool directions = !outputs.bent_normal.empty() || !outputs.cone_angle.empty();
  const vulkan::FrameShape shape{.width = field.depth.width,
                                 .height = field.depth.height,
                                 .guard_band = field.guard_band,
                                 .depth_kind = field.depth_kind,
                                 .normals = !field.normals.empty(),
                                 .normal_use = field.normal_use,
                                 .back_depth = !field.back_depth.empty(),
                                 .directions = !directions ? vulkan::Directions::kNone
                                               : frame.output == VulkanFormat::kR8
                                                   ? vulkan::Directions::kUnsigned
                                                   : vulkan::Directions::kSigned,
                                 .frames = 1};
  vulkan::Recorder recorder;
  if (Status s = vulkan::Recorder::create(
          {device.device(), vkGetDeviceProcAddr, VK_NULL_HANDLE, device.max_storage_buffer_range()},
          settings, shape, &recorder);
      !s.ok()) {
    return s;
  }
  if (recorder.pass_names().size() >= VulkanDevice::kQueries) {
    return unsupported("too many passes to time");
  }
  Resources r(device);
  Buffer scratch;
  Input depth, normals, back_depth;
  Output visibility, bent_normal;
  const bool ok =
      r.buffer(recorder.scratch_bytes(),
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false,
               &scratch) &&
      r.input(shape.width, shape.height,
              frame.depth_buffer ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R32_SFLOAT, &depth) &&
      (!shape.back_depth ||
       r.input(shape.width, shape.height, VK_FORMAT_R32_SFLOAT, &back_depth)) &&
      (!shape.normals ||
       r.input(shape.width, shape.height, VK_FORMAT_R32G32B32A32_SFLOAT, &normals)) &&
      r.output(width, height, frame.output, 1, &visibility) &&
      (!directions || r.output(width, height, frame.output, 4, &bent_normal));
  if (!ok) return {StatusCode::kOutOfMemory, "out of memory on the Vulkan device"};
  fill(field.depth, depth.upload);
  if (shape.normals) fill(field.normals, normals.upload);
  if (shape.back_depth) fill(field.back_depth, back_depth.upload);
  recorder.bind_scratch({scratch.buffer, 0});
  if (Status s = recorder.bind_images(
          0, {depth.picture.view, normals.picture.view, visibility.picture.view,
              bent_normal.picture.view, back_depth.picture.view});
      !s.ok()) {
    return s;
  }
  for (int i = 0; i < runs; ++i) {
    device.begin();
    upload(device.commands(), depth);
    if (shape.normals) upload(device.commands(), normals);
    if (shape.back_depth) upload(device.commands(), back_depth);
    make_writable(device.commands(), visibility);
    if (directions) make_writable(device.commands(), bent_normal);
    recorder.record_tables(device.commands());
    vkCmdResetQueryPool(device.commands(), device.queries(), 0, VulkanDevice::kQueries);
    const auto start = std::chrono::steady_clock::now();
    const Status status = recorder.record(
        device.commands(), 0, {field.camera, field.near_plane, field.far_plane, frame.frame_index},
        {.timestamps = device.queries(), .first_query = 0});
    const std::chrono::duration<double, std::micro> recorded =
        std::chrono::steady_clock::now() - start;
    fetch(device.commands(), visibility);
    if (directions) fetch(device.commands(), bent_normal);
    if (Status s = device.submit(); !s.ok()) return s;
    if (!status.ok()) return status;
    if (times) report(device, recorder, recorded.count(), i == 0, times);
  }
  read(visibility, 0, 1, 0, outputs.visibility);
  const bool unsigned_range = frame.output == VulkanFormat::kR8;
  const ImageView<float>* vector[] = {&outputs.bent_normal.x, &outputs.bent_normal.y,
                                      &outputs.bent_normal.z};
  for (int c = 0; c < 3; ++c) {
    read(bent_normal, c, unsigned_range ? 2.0f : 1.0f, unsigned_range ? -1.0f : 0.0f, *vector[c]);
  }
  read(bent_normal, 3, 1.57079633f, 0, outputs.cone_angle);
  return {};
}

Status HeadlessVulkan::copy_bandwidth(double* bytes_per_second) {
  VulkanDevice& device = *device_;
  constexpr VkDeviceSize kBytes = VkDeviceSize{256} << 20;
  Resources r(device);
  Buffer from, to;
  if (!r.buffer(kBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, false, &from) ||
      !r.buffer(kBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, false, &to)) {
    return {StatusCode::kOutOfMemory, "out of memory on the Vulkan device"};
  }
  *bytes_per_second = 0;
  for (int i = 0; i < 5; ++i) {
    device.begin();
    vkCmdResetQueryPool(device.commands(), device.queries(), 0, 2);
    vkCmdWriteTimestamp(device.commands(), VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, device.queries(), 0);
    const VkBufferCopy copy{0, 0, kBytes};
    vkCmdCopyBuffer(device.commands(), from.buffer, to.buffer, 1, &copy);
    vkCmdWriteTimestamp(device.commands(), VK_PIPELINE_STAGE_TRANSFER_BIT, device.queries(), 1);
    if (Status s = device.submit(); !s.ok()) return s;
    std::uint64_t ticks[2];
    vkGetQueryPoolResults(device.device(), device.queries(), 0, 2, sizeof(ticks), ticks,
                          sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    const double seconds = static_cast<double>(ticks[1] - ticks[0]) * device.tick_ns() * 1e-9;
    if (seconds > 0) *bytes_per_second = std::max(*bytes_per_second, 2.0 * kBytes / seconds);
  }
  return {};
}

double HeadlessTimes::total_ms() const {
  double sum = 0;
  for (const HeadlessPass& pass : passes) sum += pass.ms;
  return sum;
}

}  // namespace obscura::tools
