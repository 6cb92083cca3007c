#ifndef OBSCURA_SCENE_TRUTH_POINT_RAYS_H_
#define OBSCURA_SCENE_TRUTH_POINT_RAYS_H_

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "obscura/falloff.h"
#include "scene/rays/ray_scene.h"
#include "scene/scenes/random.h"
#include "scene/truth/hemisphere.h"

namespace obscura::tools {

// rho(d) and the distance beyond which it is under 2^-24, too little to be seen.
class Rho {
 public:
  explicit Rho(const Falloff& falloff) : f_(falloff) {
    const double r = f_.radius;
    switch (f_.kind) {
      case FalloffKind::kConstant:
      case FalloffKind::kQuadratic:
      case FalloffKind::kTable:
        reach_ = float(r);
        break;
      case FalloffKind::kExponential:
        reach_ = float(24 * std::numbers::ln2 * r);
        break;
      case FalloffKind::kInverseSquare:
        reach_ = float(4096 * r);
        break;
      case FalloffKind::kFunction:
        break;
    }
    any_will_do_ = f_.kind == FalloffKind::kConstant ||
                   (std::isinf(f_.radius) && f_.kind != FalloffKind::kFunction);
  }

  float reach() const { return reach_; }
  // Whether rho is 1 all the way to reach().
  bool any_will_do() const { return any_will_do_; }

  double operator()(float distance) const {
    if (distance == std::numeric_limits<float>::infinity()) return 0;
    if (any_will_do_) return 1;
    const double t = double(distance) / f_.radius;
    switch (f_.kind) {
      case FalloffKind::kExponential:
        return std::exp(-t);
      case FalloffKind::kQuadratic:
        return t < 1 ? (1 - t) * (1 - t) : 0;
      case FalloffKind::kInverseSquare:
        return 1 / (1 + t * t);
      case FalloffKind::kTable: {
        if (t > 1) return 0;
        const double at = t * double(f_.table.size() - 1);
        const std::size_t i = std::min(std::size_t(at), f_.table.size() - 2);
        return f_.table[i] + (at - double(i)) * (double(f_.table[i + 1]) - f_.table[i]);
      }
      case FalloffKind::kFunction:
        return f_.function(distance);
      case FalloffKind::kConstant:
        break;
    }
    return 1;
  }

 private:
  const Falloff& f_;
  float reach_ = std::numeric_limits<float>::infinity();
  bool any_will_do_ = false;
};

// Rays from points of a surface into the hemisphere around its normal, one in each stratum.
class PointRays {
 public:
  struct Result {
    double visibility = 0;  // mean V
    double error = 0;       // its standard error
    Vec3 sum;               // of V w, in the frame around the normal
  };

  PointRays(const RayScene& scene, const Falloff& falloff, int rays)
      : scene_(scene), rho_(falloff), hemisphere_(rays) {}

  int count() const { return hemisphere_.count(); }

  // Directions are random by `key`, whose lowest bit is free, and weighted by the cosine or
  // equally; `around` is the frame of the normal in the world. `values` holds V of each ray.
  Result trace(Vec3 origin, const Frame& around, bool cosine, std::uint64_t key,
               std::vector<float>* values) const {
    Random random(key ^ (cosine ? 1 : 0));
    Result result;
    RayScene::Bundle bundle;
    Hemisphere::Direction local[RayScene::kLanes];
    float distance[RayScene::kLanes];
    for (int first = 0; first < count(); first += RayScene::kLanes) {
      bundle.count = std::min(RayScene::kLanes, count() - first);
      for (int k = 0; k < bundle.count; ++k) {
        const std::uint64_t bits = random.bits();
        const float u = float(bits >> 40) * 0x1p-24f, v = float(bits & 0xFFFFFF) * 0x1p-24f;
        local[k] = cosine ? hemisphere_.cosine_weighted(first + k, u, v)
                          : hemisphere_.uniform(first + k, u, v);
        const Vec3 w = around.to_world({local[k].x, local[k].y, local[k].z});
        bundle.x[k] = float(w.x);
        bundle.y[k] = float(w.y);
        bundle.z[k] = float(w.z);
      }
      scene_.distances(origin, bundle, rho_.reach(), !rho_.any_will_do(), distance);
      for (int k = 0; k < bundle.count; ++k) {
        const double v = 1 - rho_(distance[k]);
        (*values)[first + k] = float(v);
        result.visibility += v;
        result.sum += Vec3{local[k].x, local[k].y, local[k].z} * v;
      }
    }
    result.visibility /= count();
    result.error = hemisphere_.standard_error(*values);
    return result;
  }

 private:
  const RayScene& scene_;
  const Rho rho_;
  const Hemisphere hemisphere_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_POINT_RAYS_H_
