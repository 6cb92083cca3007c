#include "screen/volumetric/point/plan.h"

#include "core/text.h"

namespace obscura {
namespace {

ScreenPatternFrame screen_pattern_frame(const PointSettings& settings) {
  ScreenPatternFrame f;
  f.view.radius = view::tap_radius(settings.falloff.radius);
  f.quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
  const auto pattern = disk_pattern(settings.samples, false);
  double sum = 0;
  for (const DiskSample& s : pattern) sum += s.weight_constant;
  f.samples = static_cast<int>(pattern.size());
  for (int i = 0; i < f.samples; ++i) {
    f.x[i] = pattern[i].x;
    f.y[i] = pattern[i].y;
    f.weight[i] = static_cast<float>(pattern[i].weight_constant / sum);
  }
  return f;
}

Status check_screen_pattern(const PointSettings& settings) {
  if (settings.samples > kMaxDiskSamples) {
    return invalid_argument(text("samples is ", settings.samples,
                                 "; the screen pattern has sizes in [1, ", kMaxDiskSamples, "]"));
  }
  if (settings.occluder.kind != OccluderKind::kSolid) {
    return invalid_argument(
        "occluder is thickness; the screen pattern looks at surface points only and takes solid");
  }
  return {};
}

}  // namespace

PointFrame point_frame(const PointSettings& settings, std::span<const BallSample> pattern) {
  PointFrame f;
  f.view.radius = view::tap_radius(settings.falloff.radius);
  if (settings.occluder.kind == OccluderKind::kThickness) f.thickness = settings.occluder.thickness;
  const bool quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
  auto weight = [&](const BallSample& s) {
    return quadratic ? s.weight_quadratic : s.weight_constant;
  };
  double sum = 0;
  for (const BallSample& s : pattern) sum += weight(s);
  f.samples = static_cast<int>(pattern.size());
  for (int i = 0; i < f.samples; ++i) {
    f.x[i] = pattern[i].x;
    f.y[i] = pattern[i].y;
    f.z[i] = pattern[i].z;
    f.weight[i] = static_cast<float>(weight(pattern[i]) / sum);
  }
  return f;
}

Status make_plan(const PointSettings& settings, PointPlan* plan) {
  if (Status s = check_volumetric(settings); !s.ok()) return s;
  if (settings.pattern == PointPattern::kBall) {
    plan->ball = plan_spheres(
        settings, [](const PointSettings& s) { return point_frame(s, ball_pattern(s.samples)); });
    return {};
  }
  if (Status s = check_screen_pattern(settings); !s.ok()) return s;
  plan->screen = plan_spheres(settings, screen_pattern_frame);
  return {};
}

}  // namespace obscura
