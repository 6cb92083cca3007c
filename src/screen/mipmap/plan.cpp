#include "screen/mipmap/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {
namespace {

std::vector<MipmapDirection> mipmap_directions(int count) {
  constexpr float kPi = std::numbers::pi_v<float>;
  std::vector<MipmapDirection> directions;
  for (int k = 0; k < count; ++k) {
    const float angle = 2 * kPi * static_cast<float>(k) / static_cast<float>(count);
    const float width = kPi / static_cast<float>(count);
    const float low = angle - width, high = angle + width;
    directions.push_back({std::cos(angle), std::sin(angle), std::cos(low), std::sin(low),
                          std::cos(high), std::sin(high)});
  }
  return directions;
}

}  // namespace

int mipmap_level_count(int width, int height) {
  int count = 1;
  while (std::max(width, height) >> count >= 1) ++count;
  return count;
}

std::vector<MipmapStep> mipmap_steps(const MipmapSettings& s, int width, int height) {
  const int levels = std::min(mipmap_level_count(width, height), kMaxMipmapLevels);
  const float sector = 2 * std::tan(std::numbers::pi_v<float> / static_cast<float>(s.directions));
  const float last = std::max(static_cast<float>(levels - 1) - 0.001f, 0.0f);
  std::vector<MipmapStep> steps;
  // No direction's edge is farther away than both sides together.
  const float end = static_cast<float>(width + height);
  float distance = 1, step = 1, before = 0;
  while (before < end) {
    const float lod = std::clamp(std::log2(std::max(distance * sector, 1e-6f)), 0.0f, last);
    const int level = static_cast<int>(lod);
    steps.push_back({distance, level, lod - static_cast<float>(level)});
    before = distance;
    step *= s.step_factor;
    distance += step;
  }
  return steps;
}

Status make_plan(const MipmapSettings& settings, MipmapPlan* plan) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = math::make_rho(settings.falloff, &plan->rho); !s.ok()) return s;
  plan->directions = mipmap_directions(settings.directions);
  return {};
}

}  // namespace obscura
