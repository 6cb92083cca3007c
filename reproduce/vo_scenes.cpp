#include "reproduce/vo_scenes.h"

#include <cmath>

namespace obscura::tools {
namespace {

template <class Settings>
Settings plain(float radius, int samples) {
  Settings s;
  s.falloff.radius = radius;
  s.samples = samples;
  s.blur = false;
  return s;
}

// Sets the seed of those methods that the variants are made of.
struct SetSeed {
  std::uint32_t seed;
  template <class Settings>
  void operator()(Settings& s) const {
    if constexpr (requires { s.rotate; }) s.seed = seed;
  }
};

}  // namespace

std::vector<VoVariant> vo_variants(float radius) {
  return {
      {"5 lines", plain<LineSettings>(radius, 5)},
      {"9 lines", plain<LineSettings>(radius, 9)},
      {"12 points", plain<PointSettings>(radius, 12)},
      {"33 points", plain<PointSettings>(radius, 33)},
      {"1 area", plain<AreaSettings>(radius, 1)},
      {"9 areas", plain<AreaSettings>(radius, 9)},
  };
}

VoVariant vo_horizon(float radius) {
  HorizonSettings s{.occluder = Occluder::solid()};
  s.falloff.radius = radius;
  s.directions = s.steps = 8;
  s.variant = HorizonVariant::kClassic;
  s.blur = false;
  return {"horizon, 8 x 8", s};
}

Status vo_converged_horizon(const DepthInput& input, float radius, Executor* executor,
                            std::vector<float>* visibility) {
  auto settings = std::get<HorizonSettings>(vo_horizon(radius).settings);
  settings.directions = 64;
  settings.steps = 64;
  settings.interleave = 1;
  return vo_visibility(input, settings, 1, executor, visibility);
}

MethodSettings vo_blurred(MethodSettings settings) {
  std::visit(
      [](auto& s) {
        if constexpr (requires { s.blur; }) s.blur = true;
      },
      settings);
  return settings;
}

Status vo_visibility(const DepthInput& input, MethodSettings settings, std::uint32_t seed,
                     Executor* executor, std::vector<float>* visibility) {
  std::visit(SetSeed{seed}, settings);
  const DepthField field = input.field();
  const int width = field.visible().width, height = field.visible().height;
  visibility->resize(static_cast<std::size_t>(width) * height);
  return compute(field, settings, {.visibility = {visibility->data(), width, height}},
                 {.executor = executor});
}

Status vo_converged(const DepthInput& input, float radius, int patterns, Executor* executor,
                    std::vector<float>* visibility) {
  const LineSettings settings = plain<LineSettings>(radius, 32);
  const DepthField field = input.field();
  const int width = field.visible().width, height = field.visible().height;
  std::vector<double> sum(static_cast<std::size_t>(width) * height);
  visibility->resize(sum.size());
  for (int i = 0; i < patterns; ++i) {
    LineSettings s = settings;
    s.seed = 1000u + static_cast<std::uint32_t>(i);
    s.center = i % 2 != 0;
    const Status status = compute(field, s, {.visibility = {visibility->data(), width, height}},
                                  {.executor = executor});
    if (!status.ok()) return status;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += (*visibility)[k];
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    (*visibility)[k] = static_cast<float>(sum[k] / patterns);
  }
  return {};
}

double vo_error(const DepthInput& input, const std::vector<float>& a, const std::vector<float>& b) {
  const DepthField field = input.field();
  const int width = field.visible().width, height = field.visible().height;
  double sum = 0;
  std::int64_t pixels = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float z = field.depth(x + field.guard_band.left, y + field.guard_band.top);
      const std::size_t k = static_cast<std::size_t>(y) * width + x;
      if (!std::isfinite(z) || std::isnan(a[k]) || std::isnan(b[k])) continue;
      sum += std::abs(a[k] - b[k]);
      ++pixels;
    }
  }
  return pixels ? 100 * sum / static_cast<double>(pixels) : 0;
}

}  // namespace obscura::tools
