#ifndef OBSCURA_TESTS_REFERENCE_MARCHED_RAYS_H_
#define OBSCURA_TESTS_REFERENCE_MARCHED_RAYS_H_

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "obscura/occluder.h"
#include "view/geometry.h"

// Rays against a depth image, implemented independently of the tracer: in eye space, in double
// precision, in steps of a hundredth of a pixel. Objects between two steps are missed.
namespace obscura::reference {

class MarchedRays {
 public:
  static constexpr double kStep = 0.01;  // pixels

  MarchedRays(const view::Geometry& geometry, const Occluder& occluder)
      : g_(geometry), occluder_(occluder) {}

  // Distance from p to the first blocked point along the unit direction w, or infinity.
  double distance(const double p[3], const double w[3]) const {
    const Camera& c = g_.camera;
    double t = 0;
    while (true) {
      const double q[] = {p[0] + t * w[0], p[1] + t * w[1], p[2] + t * w[2]};
      const double depth = -q[2];
      if (!c.orthographic && depth <= 0) return kNever;
      const double unit = c.orthographic ? 1 : depth;
      const double u = c.center_u + q[0] / (c.scale_x * unit);
      const double v = c.center_v - q[1] / (c.scale_y * unit);
      if (u < 0 || v < 0 || u > g_.width || v > g_.height || depth > 1e9 || t > 1e6) return kNever;
      if (occluder_.kind == OccluderKind::kSolid &&
          (u < 0.5 || v < 0.5 || u > g_.width - 0.5 || v > g_.height - 0.5)) {
        return kNever;
      }
      if (blocked(u, v, depth)) return t;
      // The step that moves the point by kStep pixels, at most 1 % of its depth.
      const double z = c.orthographic ? 0 : w[2];
      const double du = (w[0] + (u - c.center_u) * c.scale_x * z) / (c.scale_x * unit);
      const double dv = (w[1] + (c.center_v - v) * c.scale_y * z) / (c.scale_y * unit);
      t += std::min(kStep / std::max(1e-30, std::sqrt(du * du + dv * dv)),
                    0.01 * (c.orthographic ? 1 : depth));
    }
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  bool blocked(double u, double v, double depth) const {
    if (occluder_.kind != OccluderKind::kSolid) return inside_matter(u, v, depth);
    const double x = std::clamp(u - 0.5, 0.0, g_.width - 1.0);
    const double y = std::clamp(v - 0.5, 0.0, g_.height - 1.0);
    const int i = std::min(static_cast<int>(x), g_.width - 2);
    const int j = std::min(static_cast<int>(y), g_.height - 2);
    const double fx = x - i, fy = y - j;
    auto at = [&](int a, int b) {
      const double z = g_.depth(a, b);
      const double extent = std::max({g_.width * static_cast<double>(g_.camera.scale_x),
                                      g_.height * static_cast<double>(g_.camera.scale_y),
                                      static_cast<double>(g_.max_depth) - g_.min_depth});
      if (!g_.camera.orthographic) return 1 / z;
      return std::isinf(z) ? -(g_.max_depth + 1000 * extent) : -z;
    };
    const double surface = (1 - fy) * ((1 - fx) * at(i, j) + fx * at(i + 1, j)) +
                           fy * ((1 - fx) * at(i, j + 1) + fx * at(i + 1, j + 1));
    return (g_.camera.orthographic ? -depth : 1 / depth) < surface;
  }

  bool inside_matter(double u, double v, double depth) const {
    const int i = std::min(static_cast<int>(u), g_.width - 1);
    const int j = std::min(static_cast<int>(v), g_.height - 1);
    const Camera& c = g_.camera;
    if (occluder_.kind == OccluderKind::kLayers) {
      for (const view::Geometry::Layer& layer : g_.layers) {
        if (depth > layer.front(i, j) && depth < layer.back(i, j)) return true;
      }
      return false;
    }
    const double a = c.orthographic ? 0 : (i + 0.5 - c.center_u) * c.scale_x;
    const double b = c.orthographic ? 0 : (c.center_v - j - 0.5) * c.scale_y;
    const double back = occluder_.kind == OccluderKind::kBackDepth
                            ? g_.back_depth(i, j)
                            : g_.depth(i, j) + occluder_.thickness / std::sqrt(1 + a * a + b * b);
    return depth > g_.depth(i, j) && depth < back;
  }

  const view::Geometry& g_;
  const Occluder occluder_;
};

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_MARCHED_RAYS_H_
