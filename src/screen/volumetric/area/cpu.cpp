#include "core/reflection_noise.h"
#include "core/text.h"
#include "screen/rows.h"
#include "screen/volumetric/area/plan.h"

namespace obscura {
namespace {

class AreaMethod final : public Method {
 public:
  AreaMethod(const AreaSettings& settings, const AreaFrame& frame, int width, int height)
      : frame_(frame), slack_(area_slack(settings)) {
    if (settings.rotate) noise_ = ReflectionNoise(settings.seed);
    pyramid_.resize(width, height);
  }

  view::Needs needs() const override { return {.normals = true, .works_without_normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    pyramid_.build(g, slack_, context.executor);
    AreaFrame f = frame_;
    f.view = view::make_tap_frame(g, frame_.view.radius);
    f.view.noise_x = noise_.x();
    f.view.noise_y = noise_.y();
    f.texels = pyramid_.texels();
    f.levels = pyramid_.levels();
    f.columns = pyramid_.width();
    for (int l = 0; l < f.levels; ++l) {
      f.start[l] = static_cast<std::int32_t>(pyramid_.start(l));
    }
    return run_rows(g, outputs.visibility, context, [&](int row, int begin, int end, float* out) {
      area_row(f, row, begin, end, out);
    });
  }

 private:
  const AreaFrame frame_;
  const float slack_;
  ReflectionNoise noise_;
  MomentPyramid pyramid_;
};

}  // namespace

template <>
Status make_method(const AreaSettings& settings, int width, int height,
                   std::unique_ptr<Method>* method) {
  AreaPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  if (!MomentPyramid::fits(width, height)) {
    return unsupported(text("image size is ", width, "x", height,
                            "; area sampling takes images of up to 2^28 pixels"));
  }
  auto make = [&](const AreaFrame& frame) {
    return std::make_unique<AreaMethod>(settings, frame, width, height);
  };
  *method = make_spheres(settings, plan, settings.blur, width, height, make);
  return {};
}

}  // namespace obscura
