#ifndef OBSCURA_TESTS_PROPERTY_BACKDROP_H_
#define OBSCURA_TESTS_PROPERTY_BACKDROP_H_

#include <algorithm>
#include <cmath>

#include "obscura/methods.h"
#include "tests/property/synthetic.h"

namespace obscura::synthetic {

// A backdrop: what is seen where the scene has nothing, from ten times as deep as all of it on.
// Nothing in the scene, which is about a radius deep, can be obscured by that.
enum class Backdrop { kNone, kFlat, kNoisy, kAnyDepth };

// Waves and blocks with large holes, 2 to 3.4 deep, in front of a backdrop at `depth`.
inline Input before_backdrop(bool orthographic, Backdrop backdrop, double depth) {
  const int w = 120, h = 80;
  Input in{w, h, {}, {}, {}, {}};
  in.camera = orthographic ? Camera::orthographic_height(4, w, h) : Camera::perspective(0.9f, w, h);
  Random random(7);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      double z = INFINITY;
      if (y > 25 || (x > 30 && x < 55)) z = 3.1 + 0.3 * std::sin(0.15 * x) * std::cos(0.11 * y);
      if (x > 70 && x < 95 && y > 12 && y < 60) z = 2.2;
      const double disk = 180 - (x - 22) * (x - 22) - (y - 44) * (y - 44);
      if (disk > 0) z = 2.1 - 0.01 * std::sqrt(disk);
      if (x > 102 && x < 106) z = 2.5;  // a pole
      const double u = random.uniform();
      if (std::isinf(z) && backdrop == Backdrop::kFlat) z = depth;
      if (std::isinf(z) && backdrop == Backdrop::kNoisy) z = depth * (1 + 4 * u);
      if (std::isinf(z) && backdrop == Backdrop::kAnyDepth) z = 34 * std::pow(2e7, u);
      in.depth.push_back(static_cast<float>(z));
    }
  }
  return in;
}

// Calls f(what, input, the same without a backdrop) for flat and noisy backdrops of these depths,
// one of any depth, and one beyond what is a depth (obscura::kNoDepth).
template <class F>
void for_each_backdrop(const std::vector<double>& depths, const F& f) {
  for (const bool orthographic : {false, true}) {
    const Input open = before_backdrop(orthographic, Backdrop::kNone, 0);
    const char* camera = orthographic ? "orthographic, " : "perspective, ";
    for (const double depth : depths) {
      for (const Backdrop kind : {Backdrop::kFlat, Backdrop::kNoisy}) {
        f(camera + std::to_string(depth) + (kind == Backdrop::kFlat ? "" : ", noisy"),
          before_backdrop(orthographic, kind, depth), open);
      }
    }
    f(std::string(camera) + "any depth", before_backdrop(orthographic, Backdrop::kAnyDepth, 0),
      open);
    f(std::string(camera) + "3e38", before_backdrop(orthographic, Backdrop::kFlat, 3e38), open);
  }
}

// Every method at its defaults.
inline std::vector<MethodSettings> default_methods() {
  std::vector<MethodSettings> result;
  for_each_method([&]<class S>(MethodInfo<S>, S settings) {
    if constexpr (std::is_same_v<S, ReferenceSettings>) settings.rays = 16;
    result.push_back(settings);
  });
  return result;
}

// How far a result of a surface in front of a backdrop is from that without.
inline double moved(const Input& open, const std::vector<float>& a, const std::vector<float>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(open.depth[i])) most = std::max(most, std::abs(double{a[i]} - b[i]));
  }
  return most;
}

// What a backdrop may move.
inline constexpr double kUnmoved = 2e-3;

}  // namespace obscura::synthetic

#endif  // OBSCURA_TESTS_PROPERTY_BACKDROP_H_
