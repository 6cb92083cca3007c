#include "screen/horizon/plan.h"

#include <algorithm>

#include "filters/interleaved/interleaved.h"
#include "screen/method.h"

namespace obscura {
namespace {

constexpr int kRowsPerTask = 8;

class HorizonMethod final : public Method {
 public:
  HorizonMethod(const HorizonSettings& settings, HorizonPlan plan, int width, int height)
      : settings_(settings), rho_(std::move(plan.rho)), frame_(plan.frame) {
    frame_.rho = &rho_;
    sums_.resize(width, height);
  }

  view::Needs needs() const override {
    const bool back = frame_.matter == view::Matter::kWithBack;
    return view::Needs{.normals = true}.with(back ? settings_.occluder : Occluder::solid(), false);
  }
  OutputKinds output_kinds() const override {
    return {.bent_normal = true,
            .cone_angle = true,
            .uniform_integral = true,
            .cosine_integral = !classic()};
  }

  Status run(const view::Geometry& g, const Outputs& o, const RunContext& context) override {
    frame_.view = view::make_tap_frame(g, frame_.reach);
    frame_.back = frame_.matter == view::Matter::kWithBack ? g.back_depth.data() : nullptr;
    Outputs left = o;
    if (!o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty()) {
      const Sums sums = classic() ? Sums::kUniform : Sums::kUniformDirections;
      if (Status s = pass(g, left, sums, true, context); !s.ok()) return s;
      left.visibility = {};
    }
    if (left.visibility.empty() && o.cosine_integral.empty()) return {};
    const Sums sums = classic() ? Sums::kUniform : Sums::kCosine;
    return pass(g, left, sums, !o.cosine_integral.empty(), context);
  }

 private:
  using Sums = interleaved::Sums;

  bool classic() const { return settings_.variant == HorizonVariant::kClassic; }
  bool blurred() const { return settings_.blur && settings_.interleave > 1; }

  // Sums of one kind, their blur, and the results that come from them.
  Status pass(const view::Geometry& g, const Outputs& o, Sums kind, bool directions,
              const RunContext& context) {
    const int width = g.visible().width, height = g.visible().height;
    const int channels = directions ? interleaved::kChannels : 1;
    const SliceSums slice_sums = !directions             ? SliceSums::kVisibility
                                 : kind == Sums::kCosine ? SliceSums::kCosine
                                                         : SliceSums::kUniform;
    Progress progress(height, context.progress);
    auto sum_rows = [&](int first, int end) {
      for (int y = first; y < end; ++y) {
        float* out[interleaved::kChannels] = {};
        for (int c = 0; c < channels; ++c) out[c] = sums_.row(c, y);
        classic() ? horizon::classic_row(frame_, y, width, out)
                  : horizon::slices_row(frame_, slice_sums, y, width, out);
        sums_.close_row(channels, width, y);
      }
    };
    context.timer.time("sample", [&] {
      const int tasks = (height + kRowsPerTask - 1) / kRowsPerTask;
      context.executor.parallel_for(tasks, [&](int task, int) {
        if (progress.cancelled()) return;
        const int first = task * kRowsPerTask, end = std::min(height, first + kRowsPerTask);
        sum_rows(first, end);
        progress.advance(end - first);
      });
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    // A radius without end tells nothing of where one surface ends and another begins.
    context.timer.time("blur", [&] {
      sums_.resolve(g,
                    {.sums = kind,
                     .directions = directions,
                     .interleave = blurred() ? settings_.interleave : 1,
                     .edge = std::max(0.5f * rho_.radius, 1e-30f),
                     .edges_per_depth = horizon::kEdgesPerDepth,
                     .paper_cone = settings_.cone == ConeEstimate::kPaper},
                    o, context.executor);
    });
    return {};
  }

  const HorizonSettings settings_;
  const math::Rho rho_;
  horizon::Frame frame_;
  interleaved::InterleavedSums sums_;
};

}  // namespace

template <>
Status make_method(const HorizonSettings& settings, int width, int height,
                   std::unique_ptr<Method>* method) {
  HorizonPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  *method = std::make_unique<HorizonMethod>(settings, std::move(plan), width, height);
  return {};
}

}  // namespace obscura
