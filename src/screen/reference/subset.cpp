#include "screen/reference/subset.h"

#include <cmath>
#include <limits>

namespace obscura {
namespace {

template <class F>
void each_scalar(const Outputs& o, F&& f) {
  for (const auto* view : {&o.visibility, &o.cone_angle, &o.standard_error}) {
    if (!view->empty()) f(*view);
  }
}
template <class F>
void each_vector(const Outputs& o, F&& f) {
  for (const auto* view : {&o.bent_normal, &o.uniform_integral, &o.cosine_integral, &o.radiance}) {
    if (!view->empty()) f(*view, view == &o.bent_normal);
  }
}

}  // namespace

bool Subset::has_surface(int x, int y) const {
  return std::isfinite(g_.depth(x + g_.guard_band.left, y + g_.guard_band.top));
}

void Subset::choose(std::vector<Pixel>* pixels) const {
  pixels->clear();
  for (int y = every_ / 2; y < g_.visible().height; y += every_) {
    for (int x = every_ / 2; x < g_.visible().width; x += every_) {
      if (has_surface(x, y)) pixels->push_back({x, y});
    }
  }
}

void Subset::fill_with_nan(const Outputs& outputs, Executor& executor) const {
  if (every_ == 1) return;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  executor.parallel_for(g_.visible().height, [&](int y, int) {
    for (int x = 0; x < g_.visible().width; ++x) {
      if (chosen(x, y) || !has_surface(x, y)) continue;
      each_scalar(outputs, [&](const ImageView<float>& v) { v(x, y) = kNan; });
      each_vector(outputs, [&](const VectorView<float>& v, bool) {
        v.x(x, y) = v.y(x, y) = v.z(x, y) = kNan;
      });
    }
  });
}

Subset::Blend Subset::neighbours(int x, int y) const {
  Blend blend;
  auto before = [&](int at) {
    return (at + every_ - every_ / 2) / every_ * every_ - every_ + every_ / 2;
  };
  const int x0 = before(x), y0 = before(y);
  const float z = g_.depth(x + g_.guard_band.left, y + g_.guard_band.top);
  float sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int i = x0 + (k & 1) * every_, j = y0 + (k >> 1) * every_;
    if (i < 0 || j < 0 || i >= g_.visible().width || j >= g_.visible().height) continue;
    if (!has_surface(i, j)) continue;
    const float step = static_cast<float>(every_);
    const float near = (1 - std::abs(static_cast<float>(x - i)) / step) *
                       (1 - std::abs(static_cast<float>(y - j)) / step);
    const float other = g_.depth(i + g_.guard_band.left, j + g_.guard_band.top);
    // Surfaces more than half a per cent of the depth apart are hardly mixed.
    const float apart = (z - other) / (z + other);
    const float weight = near / (1e-5f + apart * apart);
    if (!(weight > 0)) continue;
    blend.pixel[blend.count] = {i, j};
    blend.weight[blend.count++] = weight;
    sum += weight;
  }
  for (int k = 0; k < blend.count; ++k) blend.weight[k] /= sum;
  return blend;
}

void Subset::interpolate(const Outputs& outputs, Executor& executor,
                         std::vector<Pixel>* orphans) const {
  orphans->clear();
  if (every_ == 1) return;
  std::vector<std::vector<Pixel>> by_row(g_.visible().height);
  executor.parallel_for(g_.visible().height, [&](int y, int) {
    for (int x = 0; x < g_.visible().width; ++x) {
      if (chosen(x, y) || !has_surface(x, y)) continue;
      const Blend b = neighbours(x, y);
      if (b.count == 0) {
        by_row[y].push_back({x, y});
        continue;
      }
      auto mix = [&](const ImageView<float>& v) {
        float sum = 0;
        for (int k = 0; k < b.count; ++k) sum += b.weight[k] * v(b.pixel[k].x, b.pixel[k].y);
        return sum;
      };
      each_scalar(outputs, [&](const ImageView<float>& v) { v(x, y) = mix(v); });
      each_vector(outputs, [&](const VectorView<float>& v, bool unit) {
        float d[] = {mix(v.x), mix(v.y), mix(v.z)};
        const float square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        const float scale = unit && square > 0 ? 1 / std::sqrt(square) : 1.0f;
        v.x(x, y) = d[0] * scale;
        v.y(x, y) = d[1] * scale;
        v.z(x, y) = d[2] * scale;
      });
    }
  });
  for (const auto& row : by_row) orphans->insert(orphans->end(), row.begin(), row.end());
}

}  // namespace obscura
