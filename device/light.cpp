// Light on a Vulkan device without a window.
#include "device/headless.h"
#include "device/transfer.h"
#include "obscura/vulkan_light.h"

namespace obscura::tools {
namespace {

// Bent normal and cone as Directions::kSigned stores them.
void fill_cones(const LightingInputs& in, const Buffer& to) {
  auto* out = static_cast<float*>(to.mapped);
  for (int y = 0; y < in.visibility.height; ++y) {
    for (int x = 0; x < in.visibility.width; ++x) {
      for (const auto* view : {&in.bent_normal.x, &in.bent_normal.y, &in.bent_normal.z}) {
        *out++ = (*view)(x, y);
      }
      *out++ = in.cone_angle.empty() ? 1.0f : in.cone_angle(x, y) / 1.57079633f;
    }
  }
}

Status check_same_size(const LightingInputs& in, const VectorView<float>& out) {
  const int w = in.visibility.width, h = in.visibility.height;
  auto differs = [&](const auto& v) { return !v.empty() && (v.width != w || v.height != h); };
  if (in.visibility.empty() || in.normal.empty() || out.empty()) {
    return invalid_argument("on Vulkan visibility, normal and out must be given");
  }
  for (const auto* v : {&in.normal, &in.bent_normal, &in.albedo}) {
    if (differs(v->x) || differs(v->y) || differs(v->z)) {
      return invalid_argument("the images to light differ in size");
    }
  }
  if (differs(in.cone_angle) || differs(out.x) || differs(out.y) || differs(out.z)) {
    return invalid_argument("the images to light differ in size");
  }
  return {};
}

}  // namespace

Status HeadlessVulkan::light(const LightingInputs& in, const PreconvolvedEnvironment& environment,
                             const LightingSettings& settings, const VectorView<float>& out,
                             double* ms) {
  VulkanDevice& device = *device_;
  if (environment.empty()) return invalid_argument("the environment is empty");
  if (Status s = check_same_size(in, out); !s.ok()) return s;
  const int width = in.visibility.width, height = in.visibility.height;
  const bool bent = !in.bent_normal.empty(), albedo = !in.albedo.empty();
  const vulkan::LightShape shape{
      .frame = {.width = width,
                .height = height,
                .directions = bent ? vulkan::Directions::kSigned : vulkan::Directions::kNone,
                .frames = 1},
      .albedo = albedo};
  vulkan::LightRecorder recorder;
  if (Status s = vulkan::LightRecorder::create(
          {device.device(), vkGetDeviceProcAddr, VK_NULL_HANDLE, device.max_storage_buffer_range()},
          settings, shape, &recorder);
      !s.ok()) {
    return s;
  }
  constexpr VkFormat kVector = VK_FORMAT_R32G32B32A32_SFLOAT;
  Resources r(device);
  Buffer table;
  Input visibility, normals, cones, colour;
  Output result;
  if (!r.buffer(recorder.environment_bytes(),
                VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false,
                &table) ||
      !r.input(width, height, VK_FORMAT_R32_SFLOAT, &visibility) ||
      !r.input(width, height, kVector, &normals) ||
      (bent && !r.input(width, height, kVector, &cones)) ||
      (albedo && !r.input(width, height, kVector, &colour)) ||
      !r.output(width, height, VulkanFormat::kR32F, 4, &result)) {
    return {StatusCode::kOutOfMemory, "out of memory on the Vulkan device"};
  }
  fill(in.visibility, visibility.upload);
  fill(in.normal, normals.upload);
  if (bent) fill_cones(in, cones.upload);
  if (albedo) fill(in.albedo, colour.upload);
  recorder.bind_environment({table.buffer, 0});
  if (Status s =
          recorder.bind_images(0, {visibility.picture.view, normals.picture.view,
                                   cones.picture.view, colour.picture.view, result.picture.view});
      !s.ok()) {
    return s;
  }
  device.begin();
  const VkCommandBuffer commands = device.commands();
  upload(commands, visibility, VK_IMAGE_LAYOUT_GENERAL);
  upload(commands, normals);
  if (bent) upload(commands, cones, VK_IMAGE_LAYOUT_GENERAL);
  if (albedo) upload(commands, colour);
  make_writable(commands, result);
  vkCmdResetQueryPool(commands, device.queries(), 0, 2);
  Status status = recorder.record_environment(commands, environment);
  if (status.ok()) {
    status = recorder.record(commands, 0, {settings.world_from_eye, environment.sun()},
                             {.timestamps = device.queries(), .first_query = 0});
  }
  fetch(commands, result);
  if (Status s = device.submit(); !s.ok()) return s;
  if (!status.ok()) return status;
  if (ms) *ms = device.ms_between(0, 1);
  read(result, 0, 1, 0, out.x);
  read(result, 1, 1, 0, out.y);
  read(result, 2, 1, 0, out.z);
  return {};
}

}  // namespace obscura::tools
