#include "screen/volumetric/area/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obscura/patterns.h"
#include "screen/volumetric/disk_lines.h"

namespace obscura {
namespace {

void set_pattern(std::span<const DiskSample> pattern, AreaFrame* frame) {
  AreaFrame& f = *frame;
  f.samples = static_cast<int>(pattern.size());
  const double sum = sum_of_weights(pattern, f.quadratic);
  for (int i = 0; i < f.samples; ++i) {
    const DiskSample& s = pattern[i];
    const DiskLine line = disk_line(s, f.quadratic, 1, sum);
    f.x[i] = s.x;
    f.y[i] = s.y;
    f.lateral[i] = line.lateral;
    f.extent[i] = line.extent;
    f.half[i] = line.half;
    f.weight[i] = line.weight;
    // The cell's volume over its sample's extent is about its area A; a disk of that area has a
    // deviation of sqrt(A / 4 pi), level l's kernel one of about 2^l / sqrt(3) pixels.
    const double area = s.weight_constant / (2 * static_cast<double>(line.extent));
    f.level[i] = static_cast<float>(std::log2(std::sqrt(3 * area / (4 * std::numbers::pi))));
  }
}

AreaFrame area_frame(const AreaSettings& settings) {
  AreaFrame f;
  f.view.radius = view::tap_radius(settings.falloff.radius);
  f.quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
  if (settings.occluder.kind == OccluderKind::kThickness) f.thickness = settings.occluder.thickness;
  set_pattern(disk_pattern(settings.samples, settings.center), &f);
  for (int l = 0; l <= kLevelTable; ++l) {
    f.width[l] = static_cast<float>(MomentPyramid::kernel_width(l));
  }
  return f;
}

}  // namespace

float area_slack(const AreaSettings& settings) {
  float radius = settings.falloff.radius;
  if (settings.dual.second_radius) radius = std::max(radius, *settings.dual.second_radius);
  return 1.25f * view::tap_radius(radius);
}

Status make_plan(const AreaSettings& settings, AreaPlan* plan) {
  if (Status s = check_volumetric(settings); !s.ok()) return s;
  *plan = plan_spheres(settings, area_frame);
  return {};
}

}  // namespace obscura
