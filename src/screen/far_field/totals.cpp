#include "screen/far_field/totals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/leaf_scalar.h"
#include "screen/far_field/finish_kernel.h"

namespace obscura {
namespace leaf_scalar {
#include "screen/far_field/blur_leaf.h"
}  // namespace leaf_scalar

namespace far_field {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kTile = 32;
constexpr int kRowsPerTask = 8;

template <class Body>  // body(y)
void for_rows(int height, Executor& executor, const Body& body) {
  executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
    const int end = std::min(height, (task + 1) * kRowsPerTask);
    for (int y = task * kRowsPerTask; y < end; ++y) body(y);
  });
}

// out(x, y) = value(sum of plane 0 at (x, y), of plane 1 at its (y, x)), tile by tile.
template <class Value>
void collect_tiles(const PhaseImage& a, const PhaseImage& b, Executor& executor,
                   AlignedImage<float>* out, const Value& value) {
  const int width = out->width(), height = out->height();
  executor.parallel_for((height + kTile - 1) / kTile, [&](int task, int) {
    const int y0 = task * kTile, y1 = std::min(height, y0 + kTile);
    for (int x0 = 0; x0 < width; x0 += kTile) {
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < std::min(width, x0 + kTile); ++x) {
          (*out)(x, y) = value(*a.at(y, x), *b.at(x, y));
        }
      }
    }
  });
}

void write(const float* values, int x, int y, int count, const ImageView<float>& to) {
  for (int i = 0; !to.empty() && i < count; ++i) to(x + i, y) = values[i];
}
void write(const float (*values)[FinishJob::kRoom], int x, int y, int count,
           const VectorView<float>& to) {
  write(values[0], x, y, count, to.x);
  write(values[1], x, y, count, to.y);
  write(values[2], x, y, count, to.z);
}

void finish_uniform(const view::Geometry& g, const Totals& totals, ConeEstimate cone, int y,
                    const Outputs& o) {
  const AlignedImage<float>* normal[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  FinishJob job;
  job.paper_cone = cone == ConeEstimate::kPaper;
  for (int x = 0; x < g.visible().width; x += FinishJob::kMaxCount) {
    job.count = std::min(FinishJob::kMaxCount, g.visible().width - x);
    for (int k = 0; k < 3; ++k) {
      job.vector[k] = totals.channel[kUniformVector + k].row(y) + x;
      job.normal[k] = normal[k]->row(y + g.guard_band.top) + g.guard_band.left + x;
    }
    job.solid = totals.channel[kObscuredSolid].row(y) + x;
    finish_directions(&job);
    write(job.integral, x, y, job.count, o.uniform_integral);
    write(job.direction, x, y, job.count, o.bent_normal);
    write(job.angle, x, y, job.count, o.cone_angle);
  }
}

void finish_cosine(const view::Geometry& g, const Totals& totals, int y,
                   const VectorView<float>& to) {
  const AlignedImage<float>* normal[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  const ImageView<float>* views[] = {&to.x, &to.y, &to.z};
  for (int k = 0; k < 3; ++k) {
    const float* sum = totals.channel[kCosineVector + k].row(y);
    const float* n = normal[k]->row(y + g.guard_band.top) + g.guard_band.left;
    for (int x = 0; x < g.visible().width; ++x) {
      (*views[k])(x, y) = 2.0f / 3 * n[x] - sum[x] / kPi;
    }
  }
}

}  // namespace

std::vector<Channel> WantedSums::channels() const {
  std::vector<Channel> list{kObscurance};
  auto add = [&](int first, int count) {
    for (int c = first; c < first + count; ++c) list.push_back(static_cast<Channel>(c));
  };
  if (uniform) add(kUniformVector, 4);
  if (cosine) add(kCosineVector, 3);
  return list;
}

void collect(const Plane planes[2], const WantedSums& wanted, Executor& executor, Totals* totals) {
  const Plane& p = planes[0];
  const SumImages &a = planes[0].sums, &b = planes[1].sums;
  auto& out = totals->channel;
  for (Channel c : wanted.channels()) out[c].resize(p.visible_width, p.visible_height);
  auto add = [&](int from_a, int from_b, int to, float sign) {
    collect_tiles(a.channel[from_a], b.channel[from_b], executor, &out[to],
                  [sign](float s, float t) { return sign * (s + t); });
  };
  auto add_vector = [&](int first) {
    // Plane 1's u is the image's v; eye space's y runs against it.
    add(first, first + 1, first, 1);
    add(first + 1, first, first + 1, -1);
    add(first + 2, first + 2, first + 2, 1);
    const float perspective = p.orthographic ? 0.0f : 1.0f;
    for_rows(p.visible_height, executor, [&](int y) {
      float* z = out[first + 2].row(y);
      add_ray({.width = p.visible_width,
               .first_a = perspective * (static_cast<float>(p.left) - p.center_u) * p.scale_u,
               .step_a = perspective * p.scale_u,
               .b = perspective * (static_cast<float>(y + p.top) - p.center_v) * p.scale_v,
               .ray = z,
               .x = out[first].row(y),
               .y = out[first + 1].row(y),
               .z = z});
    });
  };
  add(kObscurance, kObscurance, kObscurance, 1);
  if (wanted.uniform) {
    add_vector(kUniformVector);
    add(kObscuredSolid, kObscuredSolid, kObscuredSolid, 1);
  }
  if (wanted.cosine) add_vector(kCosineVector);
}

void blur_selectively(const view::Geometry& g, const WantedSums& wanted, Executor& executor,
                      Totals* totals, Totals* spare) {
  constexpr int kReach = leaf_scalar::kBlurReach;
  const int width = g.visible().width, height = g.visible().height;
  auto depth_at = [&](int x, int y) {
    return g.depth(x + g.guard_band.left, y + g.guard_band.top);
  };
  const std::vector<Channel> channels = wanted.channels();
  for (Channel c : channels) spare->channel[c].resize(width, height);
  for_rows(height, executor, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float own = totals->channel[kObscurance](x, y), depth = depth_at(x, y);
      float sum[kChannelCount] = {}, weights = 0;
      for (int dy = std::max(-kReach, -y); dy <= std::min(kReach, height - 1 - y); ++dy) {
        for (int dx = std::max(-kReach, -x); dx <= std::min(kReach, width - 1 - x); ++dx) {
          const float other = totals->channel[kObscurance](x + dx, y + dy);
          if (!leaf_scalar::blurs(own, other, depth, depth_at(x + dx, y + dy))) continue;
          const float weight = leaf_scalar::blur_weight(std::abs(dx), std::abs(dy));
          weights += weight;
          for (Channel c : channels) sum[c] += weight * totals->channel[c](x + dx, y + dy);
        }
      }
      for (Channel c : channels) {
        spare->channel[c](x, y) = weights > 0 ? sum[c] / weights : totals->channel[c](x, y);
      }
    }
  });
  for (Channel c : channels) std::swap(totals->channel[c], spare->channel[c]);
}

void finish(const view::Geometry& g, const Totals& totals, ConeEstimate cone, Executor& executor,
            const Outputs& o) {
  const int width = g.visible().width;
  const bool uniform =
      !o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty();
  for_rows(g.visible().height, executor, [&](int y) {
    if (!o.visibility.empty()) {
      const float* sum = totals.channel[kObscurance].row(y);
      for (int x = 0; x < width; ++x) {
        o.visibility(x, y) = std::clamp(1 - sum[x] / kPi, 0.0f, 1.0f);
      }
    }
    if (uniform) finish_uniform(g, totals, cone, y, o);
    if (!o.cosine_integral.empty()) finish_cosine(g, totals, y, o.cosine_integral);
  });
}

}  // namespace far_field
}  // namespace obscura
