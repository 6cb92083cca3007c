#include "screen/volumetric/point/plan.h"

#include "core/reflection_noise.h"
#include "screen/rows.h"
#include "screen/volumetric/point/kernel.h"
#include "screen/volumetric/volumetric.h"

namespace obscura {
namespace {

class PointMethod final : public Method {
 public:
  PointMethod(const PointSettings& settings, std::span<const BallSample> pattern)
      : frame_(point_frame(settings, pattern)) {
    if (settings.rotate) noise_ = ReflectionNoise(settings.seed, true);
  }

  view::Needs needs() const override { return {.normals = true, .works_without_normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    PointFrame f = frame_;
    f.view = view::make_tap_frame(g, frame_.view.radius);
    f.view.noise_x = noise_.x();
    f.view.noise_y = noise_.y();
    f.view.noise_z = noise_.z();
    return run_rows(g, outputs.visibility, context, [&](int row, int begin, int end, float* out) {
      point_ball_row(f, row, begin, end, out);
    });
  }

 private:
  PointFrame frame_;
  ReflectionNoise noise_;
};

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

Status make_point(const PointSettings& settings, std::unique_ptr<Method>* method) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  return make_point_with(settings, ball_pattern(settings.samples), method);
}

Status make_point_with(const PointSettings& settings, std::span<const BallSample> pattern,
                       std::unique_ptr<Method>* method) {
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  *method = std::make_unique<PointMethod>(settings, pattern);
  return {};
}

}  // namespace obscura
