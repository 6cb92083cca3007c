#include "screen/far_field/totals.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace obscura::far_field {
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

// The share along the view ray goes to the three axes.
void add_ray(const Plane& p, int y, const float* ray, float* x_row, float* y_row, float* z_row) {
  const float b = p.orthographic ? 0.0f : (y + p.top - p.center_v) * p.scale_v;
  for (int x = 0; x < p.visible_width; ++x) {
    const float a = p.orthographic ? 0.0f : (x + p.left - p.center_u) * p.scale_u;
    const float along = ray[x] / std::sqrt(1 + a * a + b * b);
    x_row[x] += along * a;
    y_row[x] -= along * b;
    z_row[x] = -along;
  }
}

float length_of(const float v[3]) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

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

void collect(const Plane planes[2], SumImages Plane::*member, const WantedSums& wanted,
             Executor& executor, Totals* totals) {
  const Plane& p = planes[0];
  const SumImages &a = planes[0].*member, &b = planes[1].*member;
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
    for_rows(p.visible_height, executor, [&](int y) {
      float* z = out[first + 2].row(y);
      add_ray(p, y, z, out[first].row(y), out[first + 1].row(y), z);
    });
  };
  add(kObscurance, kObscurance, kObscurance, 1);
  if (wanted.uniform) {
    add_vector(kUniformVector);
    add(kObscuredSolid, kObscuredSolid, kObscuredSolid, 1);
  }
  if (wanted.cosine) add_vector(kCosineVector);
}

void average_groups(const view::Geometry& g, Executor& executor, Groups* groups) {
  constexpr float kLeastCosine = 0.5f, kDepthRatio = 0.03f;  // section 10
  const int width = g.visible_width(), height = g.visible_height();
  const int left = g.guard_band.left, top = g.guard_band.top;
  groups->depth.resize(width, height);
  for (auto& image : groups->normal) image.resize(width, height);
  groups->accepted.resize(width, height);
  const AlignedImage<float>* normal[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  for_rows(height, executor, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float depth = g.depth(x + left, y + top);
      float n[3], sum[3] = {}, place = 0;
      for (int k = 0; k < 3; ++k) n[k] = (*normal[k])(x + left, y + top);
      unsigned accepted = 0;
      int count = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = x + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
          const float other = g.depth(nx + left, ny + top);
          // False for the background, too.
          if (!(std::abs(other - depth) <= kDepthRatio * depth)) continue;
          float m[3], dot = 0;
          for (int k = 0; k < 3; ++k) {
            m[k] = (*normal[k])(nx + left, ny + top);
            dot += m[k] * n[k];
          }
          if (dot <= kLeastCosine && (dx != 0 || dy != 0)) continue;
          accepted |= 1u << (3 * (dy + 1) + dx + 1);
          ++count;
          place += g.camera.orthographic ? other : 1 / other;
          for (int k = 0; k < 3; ++k) sum[k] += m[k];
        }
      }
      groups->accepted(x, y) = static_cast<std::uint16_t>(accepted);
      const float mean = place / static_cast<float>(std::max(count, 1));
      groups->depth(x, y) = count == 0 ? depth : g.camera.orthographic ? mean : 1 / mean;
      const float length = length_of(sum);
      for (int k = 0; k < 3; ++k) groups->normal[k](x, y) = length > 0 ? sum[k] / length : n[k];
    }
  });
}

void gather(const Groups& groups, const Totals& far, const WantedSums& wanted, Executor& executor,
            Totals* totals) {
  const int width = groups.depth.width(), height = groups.depth.height();
  const std::vector<Channel> channels = wanted.channels();
  for_rows(height, executor, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const unsigned accepted = groups.accepted(x, y);
      float sum[kChannelCount] = {};
      int count = 0;
      for (unsigned bits = accepted; bits != 0; bits &= bits - 1, ++count) {
        const int bit = std::countr_zero(bits), dx = bit % 3 - 1, dy = bit / 3 - 1;
        for (Channel c : channels) sum[c] += far.channel[c](x + dx, y + dy);
      }
      const float scale = count > 0 ? 9.0f / static_cast<float>(count) : 0.0f;
      for (Channel c : channels) totals->channel[c](x, y) += scale * sum[c];
    }
  });
}

void blur_selectively(const Groups& groups, const WantedSums& wanted, Executor& executor,
                      Totals* totals, Totals* spare) {
  constexpr float kWeights[] = {1, 2, 3, 2, 1}, kThreshold = 0.07f * kPi, kDepthRatio = 0.03f;
  const int width = groups.depth.width(), height = groups.depth.height();
  const std::vector<Channel> channels = wanted.channels();
  for (Channel c : channels) spare->channel[c].resize(width, height);
  for_rows(height, executor, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float own = totals->channel[kObscurance](x, y), depth = groups.depth(x, y);
      float sum[kChannelCount] = {}, weights = 0;
      for (int dy = std::max(-2, -y); dy <= std::min(2, height - 1 - y); ++dy) {
        for (int dx = std::max(-2, -x); dx <= std::min(2, width - 1 - x); ++dx) {
          const float other = totals->channel[kObscurance](x + dx, y + dy);
          const float gap = std::abs(groups.depth(x + dx, y + dy) - depth);
          if (!(std::abs(other - own) <= kThreshold && gap <= kDepthRatio * depth)) continue;
          const float weight = kWeights[dx + 2] * kWeights[dy + 2];
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
  const int width = g.visible_width();
  auto set = [](const VectorView<float>& to, int x, int y, const float v[3], float scale) {
    to.x(x, y) = v[0] * scale;
    to.y(x, y) = v[1] * scale;
    to.z(x, y) = v[2] * scale;
  };
  const bool uniform =
      !o.bent_normal.empty() || !o.cone_angle.empty() || !o.uniform_integral.empty();
  for_rows(g.visible_height(), executor, [&](int y) {
    if (!o.visibility.empty()) {
      const float* sum = totals.channel[kObscurance].row(y);
      for (int x = 0; x < width; ++x) {
        o.visibility(x, y) = std::clamp(1 - sum[x] / kPi, 0.0f, 1.0f);
      }
    }
    if (!uniform && o.cosine_integral.empty()) return;
    for (int x = 0; x < width; ++x) {
      const int u = x + g.guard_band.left, v = y + g.guard_band.top;
      const float n[3] = {g.normal_x(u, v), g.normal_y(u, v), g.normal_z(u, v)};
      float integral[3];
      auto open = [&](int first, float all) {
        for (int k = 0; k < 3; ++k) {
          integral[k] = all * n[k] - totals.channel[first + k](x, y) / kPi;
        }
      };
      if (!o.cosine_integral.empty()) {
        open(kCosineVector, 2.0f / 3);
        set(o.cosine_integral, x, y, integral, 1);
      }
      if (!uniform) continue;
      open(kUniformVector, 1);
      const float length = length_of(integral);
      // Where next to nothing is open its direction is noise.
      constexpr float kLeast = 1e-3f;
      if (!o.uniform_integral.empty()) set(o.uniform_integral, x, y, integral, 1);
      if (!o.bent_normal.empty()) {
        length > kLeast ? set(o.bent_normal, x, y, integral, 1 / length)
                        : set(o.bent_normal, x, y, n, 1);
      }
      if (o.cone_angle.empty()) continue;
      const float ambient = 1 - totals.channel[kObscuredSolid](x, y) / (2 * kPi);
      o.cone_angle(x, y) = length > kLeast
                               ? cone_angle(cone, mean_length_of_uniform_integral(length, ambient))
                               : 0.0f;
    }
  });
}

}  // namespace obscura::far_field
