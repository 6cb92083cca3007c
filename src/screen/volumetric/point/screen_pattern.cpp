#include "screen/volumetric/point/screen_pattern.h"

#include <algorithm>

#include "core/reflection_noise.h"
#include "filters/interleaved/interleaved.h"

namespace obscura {
namespace {

constexpr int kRowsPerTask = 8;

class ScreenPointMethod final : public Method {
 public:
  ScreenPointMethod(const PointSettings& settings, const ScreenPatternFrame& frame, int width,
                    int height)
      : settings_(settings), frame_(frame) {
    if (settings.rotate) noise_ = ReflectionNoise(settings.seed);
    sums_.resize(width, height);
  }

  view::Needs needs() const override { return {.normals = true, .works_without_normals = true}; }
  OutputKinds output_kinds() const override {
    return {.bent_normal = true, .cone_angle = true, .uniform_integral = true};
  }

  Status run(const view::Geometry& g, const Outputs& o, const RunContext& context) override {
    const bool directions =
        !o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty();
    if (directions && !g.has_normals) {
      return unsupported("bent normals need normals; normal_use is none");
    }
    if (!directions && o.visibility.empty()) return {};
    frame_.view = view::make_tap_frame(g, frame_.view.radius);
    frame_.view.noise_x = noise_.x();
    frame_.view.noise_y = noise_.y();
    bool cancelled = false;
    context.timer.time("sample", [&] { cancelled = !sample(g, directions, context); });
    if (cancelled) return {StatusCode::kCancelled, "stopped by the caller"};
    context.timer.time("blur", [&] {
      sums_.resolve(g,
                    {.sums = interleaved::Sums::kUniform,
                     .directions = directions,
                     .interleave = settings_.blur ? kScreenPatternInterleave : 1,
                     .edge = 0.5f * frame_.view.radius,
                     .paper_cone = false},
                    o, context.executor);
    });
    return {};
  }

 private:
  // False: stopped by the caller.
  bool sample(const view::Geometry& g, bool directions, const RunContext& context) {
    const int width = g.visible().width, height = g.visible().height;
    const int channels = directions ? interleaved::kChannels : 1;
    Progress progress(height, context.progress);
    const int tasks = (height + kRowsPerTask - 1) / kRowsPerTask;
    context.executor.parallel_for(tasks, [&](int task, int) {
      if (progress.cancelled()) return;
      const int first = task * kRowsPerTask, end = std::min(height, first + kRowsPerTask);
      for (int y = first; y < end; ++y) {
        float* out[interleaved::kChannels] = {};
        for (int c = 0; c < channels; ++c) out[c] = sums_.row(c, y);
        screen_pattern_row(frame_, y, width, out);
        sums_.close_row(channels, width, y);
      }
      progress.advance(end - first);
    });
    return !progress.cancelled();
  }

  const PointSettings settings_;
  ScreenPatternFrame frame_;
  ReflectionNoise noise_;
  interleaved::InterleavedSums sums_;
};

}  // namespace

std::unique_ptr<Method> make_screen_point(const PointSettings& settings,
                                          const ScreenPatternFrame& frame, int width, int height) {
  return std::make_unique<ScreenPointMethod>(settings, frame, width, height);
}

}  // namespace obscura
