#include "screen/reference/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obscura/cone.h"
#include "screen/method.h"
#include "screen/reference/depth_scene.h"
#include "screen/reference/pixel_tracer.h"
#include "screen/reference/subset.h"

namespace obscura {
namespace {

void write(const ImageView<float>& view, Pixel p, double value) {
  if (!view.empty()) view(p.x, p.y) = static_cast<float>(value);
}

void write(const VectorView<float>& view, Pixel p, const double* v, double scale) {
  write(view.x, p, v[0] * scale);
  write(view.y, p, v[1] * scale);
  write(view.z, p, v[2] * scale);
}

class ReferenceMethod final : public Method {
 public:
  ReferenceMethod(const ReferenceSettings& settings, ReferencePlan plan)
      : settings_(settings), plan_(std::move(plan)) {}

  view::Needs needs() const override {
    return view::Needs{.normals = true}.with(settings_.occluder, true);
  }
  OutputKinds output_kinds() const override {
    return {true, true, true, true, true, static_cast<bool>(settings_.radiance)};
  }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    scene_.build(g, settings_.occluder, context.executor);
    TraceScene scene = scene_.trace();
    scene.max_distance = plan_.reach;
    scene.beyond_border = settings_.beyond_border > 0 ? settings_.beyond_border
                                                      : std::numeric_limits<float>::infinity();
    tracers_.resize(context.executor.thread_count());
    const bool plain = !outputs.visibility.empty() || !outputs.standard_error.empty();
    const bool uniform = settings_.weighting == RayWeighting::kUniform;
    PixelTracer::Frame frame{&g, &scene, &plan_.rho, &settings_, false, false, false};
    frame.radiance = !outputs.radiance.empty();
    frame.cosine = (plain && !uniform) || !outputs.cosine_integral.empty() || frame.radiance;
    frame.uniform = (plain && uniform) || !outputs.bent_normal.empty() ||
                    !outputs.cone_angle.empty() || !outputs.uniform_integral.empty();

    const Subset subset(g, settings_.every);
    subset.choose(&pixels_);
    Progress progress(static_cast<std::int64_t>(pixels_.size()), context.progress);
    trace(frame, outputs, context.executor, &progress);
    if (!settings_.interpolate) {
      subset.fill_with_nan(outputs, context.executor);
    } else if (!progress.cancelled()) {
      // Pixels without a traced one near them are traced after all.
      subset.interpolate(outputs, context.executor, &pixels_);
      Progress rest(static_cast<std::int64_t>(pixels_.size()), no_callback_);
      trace(frame, outputs, context.executor, &rest);
    }
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    return {};
  }

 private:
  void trace(const PixelTracer::Frame& frame, const Outputs& outputs, Executor& executor,
             Progress* progress) {
    constexpr int kPixels = PixelTracer::kMaxPixels;
    const int total = static_cast<int>(pixels_.size());
    executor.parallel_for((total + kPixels - 1) / kPixels, [&](int task, int worker) {
      if (progress->cancelled()) return;
      const int first = task * kPixels, count = std::min(kPixels, total - first);
      if (!tracers_[worker]) tracers_[worker] = std::make_unique<PixelTracer>();
      PixelEstimate estimates[kPixels];
      // Long runs stop within a pixel's time, and still fill batches of short ones.
      const int step = std::clamp(RayBatch::kCapacity / settings_.rays, 1, kPixels);
      for (int i = 0; i < count && !progress->cancelled(); i += step) {
        const int some = std::min(step, count - i);
        tracers_[worker]->trace(frame, &pixels_[first + i], some, estimates);
        for (int k = 0; k < some; ++k) {
          write_pixel(*frame.geometry, outputs, pixels_[first + i + k], estimates[k]);
        }
      }
      progress->advance(count);
    });
  }

  void write_pixel(const view::Geometry& g, const Outputs& o, Pixel p,
                   const PixelEstimate& e) const {
    const bool uniform = settings_.weighting == RayWeighting::kUniform;
    const HemisphereEstimate& asked = uniform ? e.uniform : e.cosine;
    write(o.visibility, p, std::clamp(asked.visibility, 0.0, 1.0));
    write(o.standard_error, p, asked.standard_error);
    write(o.cosine_integral, p, e.cosine.direction, 1);
    write(o.radiance, p, e.cosine.radiance, 1);
    // Uniform rays have the density 1 / (2 pi): their mean is half of N.
    write(o.uniform_integral, p, e.uniform.direction, 2);
    if (o.bent_normal.empty() && o.cone_angle.empty()) return;
    const double* v = e.uniform.direction;
    const int x = p.x + g.guard_band.left, y = p.y + g.guard_band.top;
    auto twice = [](double part) { return static_cast<float>(2 * part); };
    const BentCone cone = bent_cone(ConeEstimate::kExact, {twice(v[0]), twice(v[1]), twice(v[2])},
                                    static_cast<float>(e.uniform.visibility),
                                    {g.normal_x(x, y), g.normal_y(x, y), g.normal_z(x, y)});
    const double direction[] = {cone.direction[0], cone.direction[1], cone.direction[2]};
    write(o.bent_normal, p, direction, 1);
    write(o.cone_angle, p, cone.angle);
  }

  const ReferenceSettings settings_;
  const ReferencePlan plan_;
  const std::function<bool(double)> no_callback_;
  DepthScene scene_;
  std::vector<std::unique_ptr<PixelTracer>> tracers_;
  std::vector<Pixel> pixels_;
};

}  // namespace

template <>
Status make_method(const ReferenceSettings& settings, int, int, std::unique_ptr<Method>* method) {
  ReferencePlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  *method = std::make_unique<ReferenceMethod>(settings, std::move(plan));
  return {};
}

}  // namespace obscura
