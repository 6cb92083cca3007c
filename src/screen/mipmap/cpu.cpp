#include "screen/mipmap/plan.h"

#include <algorithm>
#include <cmath>

#include "math/leaf_scalar.h"
#include "screen/method.h"

namespace obscura {
namespace leaf_scalar {
#include "math/apart_leaf.h"
// After apart_leaf.h.
#include "screen/mipmap/mipmap_leaf.h"
}  // namespace leaf_scalar

namespace {

class MipmapMethod final : public Method {
 public:
  MipmapMethod(const MipmapSettings& settings, MipmapPlan plan)
      : settings_(settings), plan_(std::move(plan)) {}

  view::Needs needs() const override { return {.normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    context.timer.time("pyramid", [&] { build(g, context.executor); });
    MipmapFrame f;
    f.geometry = &g;
    f.rho = &plan_.rho;
    for (const AlignedImage<float>& level : levels_) {
      if (f.level_count == kMaxMipmapLevels) break;
      f.levels[f.level_count++] = {level.data(), level.width(), level.height(), level.stride()};
    }
    const auto steps = mipmap_steps(settings_, g.width, g.height);
    f.directions = plan_.directions;
    f.steps = steps;
    f.interpolate = settings_.pyramid == DepthPyramid::kAverage;
    const int width = g.visible().width, height = g.visible().height;
    rows_.resize(width, height);
    Progress progress(height, context.progress);
    context.timer.time("evaluate", [&] {
      context.executor.parallel_for(height, [&](int y, int) {
        if (progress.cancelled()) return;
        mipmap_row(f, y, rows_.row(y));
        for (int x = 0; x < width; ++x) outputs.visibility(x, y) = rows_(x, y);
        progress.advance();
      });
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "stopped by the caller"};
    return {};
  }

 private:
  void build(const view::Geometry& g, Executor& executor) {
    const int count = mipmap_level_count(g.width, g.height);
    levels_.resize(count);
    levels_[0].resize(g.width, g.height);
    executor.parallel_for(g.height, [&](int y, int) {
      for (int x = 0; x < g.width; ++x) {
        const float d = g.depth(x, y);
        levels_[0](x, y) = std::isfinite(d) ? d : 0;
      }
    });
    const bool mean = settings_.pyramid == DepthPyramid::kAverage;
    for (int i = 1; i < count; ++i) {
      const AlignedImage<float>& fine = levels_[i - 1];
      AlignedImage<float>& coarse = levels_[i];
      coarse.resize((fine.width() + 1) / 2, (fine.height() + 1) / 2);
      executor.parallel_for(coarse.height(), [&](int y, int) {
        const int y0 = 2 * y, y1 = std::min(y0 + 1, fine.height() - 1);
        for (int x = 0; x < coarse.width(); ++x) {
          const int x0 = 2 * x, x1 = std::min(x0 + 1, fine.width() - 1);
          float four[] = {fine(x0, y0), fine(x1, y0), fine(x0, y1), fine(x1, y1)};
          coarse(x, y) = leaf_scalar::depth_of_four(four, mean);
        }
      });
    }
  }

  const MipmapSettings settings_;
  const MipmapPlan plan_;
  std::vector<AlignedImage<float>> levels_;
  AlignedImage<float> rows_;
};

}  // namespace

template <>
Status make_method(const MipmapSettings& settings, int, int, std::unique_ptr<Method>* method) {
  MipmapPlan plan;
  if (Status s = make_plan(settings, &plan); !s.ok()) return s;
  *method = std::make_unique<MipmapMethod>(settings, std::move(plan));
  return {};
}

}  // namespace obscura
