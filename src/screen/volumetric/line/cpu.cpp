#include "screen/volumetric/line/plan.h"

#include <algorithm>
#include <cmath>

#include "core/reflection_noise.h"
#include "screen/rows.h"
#include "screen/volumetric/disk_lines.h"
#include "screen/volumetric/line/kernel.h"
#include "screen/volumetric/volumetric.h"

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

class LineMethod final : public Method {
 public:
  LineMethod(const LineSettings& settings, std::span<const DiskSample> pattern)
      : frame_(line_frame(settings, pattern)) {
    if (settings.rotate) noise_ = ReflectionNoise(settings.seed);
  }

  view::Needs needs() const override { return {.normals = true, .works_without_normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    if (frame_.tangent && !g.has_normals) {
      return invalid_argument("sphere is tangent, which needs normals, but normals are off");
    }
    LineFrame f = frame_;
    f.view = view::make_tap_frame(g, frame_.view.radius);
    f.view.noise_x = noise_.x();
    f.view.noise_y = noise_.y();
    return run_rows(g, outputs.visibility, context, [&](int row, int begin, int end, float* out) {
      line_row(f, row, begin, end, out);
    });
  }

 private:
  LineFrame frame_;
  ReflectionNoise noise_;
};

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

Status make_line(const LineSettings& settings, std::unique_ptr<Method>* method) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  return make_line_with(settings, disk_pattern(settings.samples, settings.center), method);
}

Status make_line_with(const LineSettings& settings, std::span<const DiskSample> pattern,
                      std::unique_ptr<Method>* method) {
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  *method = std::make_unique<LineMethod>(settings, pattern);
  return {};
}

}  // namespace obscura
