#include "screen/volumetric/area/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/reflection_noise.h"
#include "core/text.h"
#include "obscura/patterns.h"
#include "screen/rows.h"
#include "screen/volumetric/area/kernel.h"
#include "screen/volumetric/disk_lines.h"
#include "screen/volumetric/volumetric.h"

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

class AreaMethod final : public Method {
 public:
  AreaMethod(const AreaSettings& settings, int width, int height) : frame_(area_frame(settings)) {
    if (settings.rotate) noise_ = ReflectionNoise(settings.seed);
    pyramid_.resize(width, height);
  }

  view::Needs needs() const override { return {.normals = true, .works_without_normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    pyramid_.build(g, context.executor);
    AreaFrame f = frame_;
    f.view = view::make_tap_frame(g, frame_.view.radius);
    f.view.noise_x = noise_.x();
    f.view.noise_y = noise_.y();
    f.texels = pyramid_.texels();
    f.levels = pyramid_.levels();
    f.stride = pyramid_.stride();
    for (int l = 0; l < f.levels; ++l) {
      f.start[l] = static_cast<std::int32_t>(pyramid_.start(l));
    }
    return run_rows(g, outputs.visibility, context, [&](int row, int begin, int end, float* out) {
      area_row(f, row, begin, end, out);
    });
  }

 private:
  AreaFrame frame_;
  ReflectionNoise noise_;
  MomentPyramid pyramid_;
};

}  // namespace

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

Status make_area(const AreaSettings& settings, int width, int height,
                 std::unique_ptr<Method>* method) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_volumetric(settings.falloff, settings.occluder); !s.ok()) return s;
  if (!MomentPyramid::fits(width, height)) {
    return unsupported(text("image size is ", width, "x", height,
                            "; area sampling takes images of up to 2^28 pixels"));
  }
  *method = std::make_unique<AreaMethod>(settings, width, height);
  return {};
}

}  // namespace obscura
