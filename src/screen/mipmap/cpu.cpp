#include "screen/mipmap/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/leaf_scalar.h"
#include "screen/mipmap/kernel.h"

namespace obscura {
namespace leaf_scalar {
#include "screen/mipmap/mipmap_leaf.h"
}  // namespace leaf_scalar

int mipmap_level_count(int width, int height) {
  int count = 1;
  while (std::max(width, height) >> count >= 1) ++count;
  return count;
}

std::vector<MipmapStep> mipmap_steps(const MipmapSettings& s, int width, int height) {
  const int levels = std::min(mipmap_level_count(width, height), kMaxMipmapLevels);
  const float sector = 2 * std::tan(std::numbers::pi_v<float> / static_cast<float>(s.directions));
  const float last = std::max(static_cast<float>(levels - 1) - 0.001f, 0.0f);
  std::vector<MipmapStep> steps;
  // No direction's edge is farther away than both sides together.
  const float end = static_cast<float>(width + height);
  float distance = 1, step = 1, before = 0;
  while (before < end) {
    const float lod = std::clamp(std::log2(std::max(distance * sector, 1e-6f)), 0.0f, last);
    const int level = static_cast<int>(lod);
    steps.push_back({distance, level, lod - static_cast<float>(level)});
    before = distance;
    step *= s.step_factor;
    distance += step;
  }
  return steps;
}

std::vector<MipmapDirection> mipmap_directions(int count) {
  constexpr float kPi = std::numbers::pi_v<float>;
  std::vector<MipmapDirection> directions;
  for (int k = 0; k < count; ++k) {
    const float angle = 2 * kPi * static_cast<float>(k) / static_cast<float>(count);
    const float width = kPi / static_cast<float>(count);
    const float low = angle - width, high = angle + width;
    directions.push_back({std::cos(angle), std::sin(angle), std::cos(low), std::sin(low),
                          std::cos(high), std::sin(high)});
  }
  return directions;
}

namespace {

class MipmapMethod final : public Method {
 public:
  MipmapMethod(const MipmapSettings& settings, math::Rho rho)
      : settings_(settings), rho_(std::move(rho)) {}

  view::Needs needs() const override { return {.normals = true}; }

  Status run(const view::Geometry& g, const Outputs& outputs, const RunContext& context) override {
    if (outputs.visibility.empty()) return {};
    context.timer.time("pyramid", [&] { build(g, context.executor); });
    MipmapFrame f;
    f.geometry = &g;
    f.rho = &rho_;
    for (const AlignedImage<float>& level : levels_) {
      if (f.level_count == kMaxMipmapLevels) break;
      f.levels[f.level_count++] = {level.data(), level.width(), level.height(), level.stride()};
    }
    const auto directions = mipmap_directions(settings_.directions);
    const auto steps = mipmap_steps(settings_, g.width, g.height);
    f.directions = directions;
    f.steps = steps;
    f.interpolate = settings_.pyramid == DepthPyramid::kAverage;
    const int width = g.visible_width(), height = g.visible_height();
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
  const math::Rho rho_;
  std::vector<AlignedImage<float>> levels_;
  AlignedImage<float> rows_;
};

}  // namespace

Status check_mipmap(const MipmapSettings& settings, math::Rho* rho) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = validate(settings.falloff); !s.ok()) return s;
  return math::make_rho(settings.falloff, rho);
}

Status make_mipmap(const MipmapSettings& settings, std::unique_ptr<Method>* method) {
  math::Rho rho;
  if (Status s = check_mipmap(settings, &rho); !s.ok()) return s;
  *method = std::make_unique<MipmapMethod>(settings, std::move(rho));
  return {};
}

}  // namespace obscura
