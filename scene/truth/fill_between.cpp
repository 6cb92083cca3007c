#include "scene/truth/fill_between.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/meshes/vec3.h"

namespace obscura::tools {
namespace {

struct Receiver {
  Vec3 position, normal;
};

Receiver receiver(const DepthInput& g, int x, int y) {
  const std::size_t i = std::size_t(y) * g.width + x;
  const Camera& c = g.camera;
  const double depth = g.depth[i], away = c.orthographic ? 1 : depth;
  return {{(x + 0.5 - c.center_u) * c.scale_x * away, (c.center_v - (y + 0.5)) * c.scale_y * away,
           -depth},
          {g.normal_x[i], g.normal_y[i], g.normal_z[i]}};
}

// 1 for a neighbour on the receiver's tangent plane with the same normal; never 0, so that a pixel
// that differs from all four still gets their mean.
double likeness(const Receiver& p, const Receiver& q) {
  const Vec3 step = q.position - p.position;
  const double off_plane = std::abs(dot(step, p.normal)) / (length(step) + 1e-30);
  const double turned = std::max(0.0, dot(p.normal, q.normal));
  return std::exp(-8 * off_plane) * std::pow(turned, 8) + 1e-4;
}

}  // namespace

void fill_between(const DepthInput& g, int every, const Outputs& outputs, Executor& executor) {
  std::vector<ImageView<float>> planes;
  for (const auto& v : {outputs.visibility, outputs.cone_angle, outputs.standard_error}) {
    if (!v.empty()) planes.push_back(v);
  }
  for (const auto& v : {outputs.bent_normal, outputs.uniform_integral, outputs.cosine_integral}) {
    if (!v.empty()) planes.insert(planes.end(), {v.x, v.y, v.z});
  }
  const int width = g.width - g.guard_band.left - g.guard_band.right;
  const int height = g.height - g.guard_band.top - g.guard_band.bottom;
  const int half = every / 2;
  auto finite = [&](int x, int y) {
    return std::isfinite(
        g.depth[std::size_t(y + g.guard_band.top) * g.width + x + g.guard_band.left]);
  };
  auto at = [&](int x, int y) { return receiver(g, x + g.guard_band.left, y + g.guard_band.top); };
  executor.parallel_for(height, [&](int y, int) {
    for (int x = 0; x < width; ++x) {
      if (!finite(x, y) || (x % every == half && y % every == half)) continue;
      const double u = double(x - half) / every, v = double(y - half) / every;
      const Receiver here = at(x, y);
      double weights[4], total = 0;
      int xs[4], ys[4];
      for (int k = 0; k < 4; ++k) {
        const double i = std::floor(u) + (k & 1), j = std::floor(v) + (k >> 1);
        xs[k] = int(i) * every + half;
        ys[k] = int(j) * every + half;
        // Outside the image the nearest traced row or column stands in.
        while (xs[k] < 0) xs[k] += every;
        while (xs[k] >= width && xs[k] >= every) xs[k] -= every;
        while (ys[k] < 0) ys[k] += every;
        while (ys[k] >= height && ys[k] >= every) ys[k] -= every;
        weights[k] = 0;
        if (xs[k] >= width || ys[k] >= height || !finite(xs[k], ys[k])) continue;
        const double bilinear = (1 - std::abs(u - i)) * (1 - std::abs(v - j));
        weights[k] = (bilinear + 1e-6) * likeness(here, at(xs[k], ys[k]));
        total += weights[k];
      }
      if (!(total > 0)) continue;
      for (const ImageView<float>& plane : planes) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) {
          if (weights[k] > 0) sum += weights[k] * plane(xs[k], ys[k]);
        }
        plane(x, y) = float(sum / total);
      }
      if (!outputs.bent_normal.empty()) {
        const VectorView<float>& b = outputs.bent_normal;
        const double inverse = 1 / std::max(1e-30, length({b.x(x, y), b.y(x, y), b.z(x, y)}));
        for (const auto* channel : {&b.x, &b.y, &b.z}) {
          (*channel)(x, y) = float((*channel)(x, y) * inverse);
        }
      }
    }
  });
}

}  // namespace obscura::tools
