#include "screen/gpu.h"

#include "screen/half_resolution/gpu.h"

namespace obscura::gpu {
namespace {

template <class Settings>
Status make_full(const Settings& settings, const Frame& frame, Program* program) {
  using Info = MethodInfo<Settings>;
  if constexpr (Info::on_vulkan) {
    return make_program(settings, frame, program);
  } else {
    return unsupported(std::string("the method ") + Info::name + " does not run on Vulkan");
  }
}

// Whether a method reads where matter ends.
template <class Settings>
bool reads_back(const Settings& settings) {
  if constexpr (requires { settings.occluder; }) {
    return settings.occluder.kind == OccluderKind::kBackDepth ||
           settings.occluder.kind == OccluderKind::kAuto;
  }
  return false;
}

template <class Settings>
Status make_any(const Settings& settings, const Frame& frame, Program* program) {
  if constexpr (requires { settings.resolution; }) {
    if (settings.resolution == Resolution::kHalf) {
      return make_half_program(
          frame, reads_back(settings),
          [&](const Frame& half) { return make_full(settings, half, program); }, program);
    }
  }
  return make_full(settings, frame, program);
}

}  // namespace

Status make_program(const MethodSettings& settings, const FrameShape& shape, Program* program) {
  const Frame frame{.shape = shape, .results = Results::images(shape)};
  return std::visit([&](const auto& method) { return make_any(method, frame, program); }, settings);
}

}  // namespace obscura::gpu
