#include "core/reflection_noise.h"
#include "screen/rows.h"
#include "screen/volumetric/line/plan.h"

namespace obscura {
namespace {

class LineMethod final : public Method {
 public:
  LineMethod(const LineSettings& settings, const LineFrame& frame) : frame_(frame) {
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
  const LineFrame frame_;
  ReflectionNoise noise_;
};

}  // namespace

template <>
Status make_method(const LineSettings& settings, int width, int height,
                   std::unique_ptr<Method>* method) {
  LinePlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  auto make = [&](const LineFrame& frame) { return std::make_unique<LineMethod>(settings, frame); };
  *method = make_spheres(settings, plan, settings.blur, width, height, make);
  return {};
}

}  // namespace obscura
