#include "screen/volumetric/line/plan.h"

#include "screen/volumetric/disk_lines.h"

namespace obscura {
namespace {

// The pattern in the units that the kernel wants.
void set_pattern(std::span<const DiskSample> pattern, LineFrame* f) {
  const double scale = f->tangent ? 0.5 : 1;  // the sphere's radius over the setting's
  const double radius = scale * f->view.radius;
  const double unit = f->quadratic ? 1 : radius;
  f->samples = static_cast<int>(pattern.size());
  f->per_unit = static_cast<float>(unit / radius);
  const double sum = sum_of_weights(pattern, f->quadratic);
  for (int i = 0; i < f->samples; ++i) {
    const DiskLine line = disk_line(pattern[i], f->quadratic, unit, sum);
    f->x[i] = static_cast<float>(scale * pattern[i].x);
    f->y[i] = static_cast<float>(scale * pattern[i].y);
    f->lateral[i] = line.lateral;
    f->extent[i] = line.extent;
    f->half[i] = line.half;
    f->weight[i] = line.weight;
  }
}

}  // namespace

LineFrame line_frame(const LineSettings& settings, std::span<const DiskSample> pattern) {
  LineFrame f;
  f.view.radius = view::tap_radius(settings.falloff.radius);
  f.quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
  f.tangent = settings.sphere == SphereKind::kTangent;
  if (settings.occluder.kind == OccluderKind::kThickness) f.thickness = settings.occluder.thickness;
  set_pattern(pattern, &f);
  return f;
}

Status make_plan(const LineSettings& settings, LinePlan* plan) {
  if (Status s = check_volumetric(settings); !s.ok()) return s;
  *plan = plan_spheres(settings, [](const LineSettings& s) {
    return line_frame(s, disk_pattern(s.samples, s.center));
  });
  return {};
}

}  // namespace obscura
