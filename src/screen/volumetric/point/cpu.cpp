#include "core/reflection_noise.h"
#include "screen/rows.h"
#include "screen/volumetric/point/plan.h"
#include "screen/volumetric/point/screen_pattern.h"

namespace obscura {
namespace {

class PointMethod final : public Method {
 public:
  PointMethod(const PointSettings& settings, const PointFrame& frame) : frame_(frame) {
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
  const PointFrame frame_;
  ReflectionNoise noise_;
};

}  // namespace

template <>
Status make_method(const PointSettings& settings, int width, int height,
                   std::unique_ptr<Method>* method) {
  PointPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (settings.pattern == PointPattern::kBall) {
    auto make = [&](const PointFrame& frame) {
      return std::make_unique<PointMethod>(settings, frame);
    };
    *method = make_spheres(settings, plan.ball, settings.blur, width, height, make);
    return {};
  }
  // The screen pattern blurs by itself: directions go the same way as visibility.
  auto make = [&](const ScreenPatternFrame& frame) {
    return make_screen_point(settings, frame, width, height);
  };
  *method = make_spheres(settings, plan.screen, false, width, height, make);
  return {};
}

}  // namespace obscura
