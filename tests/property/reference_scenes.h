#ifndef OBSCURA_TESTS_PROPERTY_REFERENCE_SCENES_H_
#define OBSCURA_TESTS_PROPERTY_REFERENCE_SCENES_H_

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "obscura/estimator.h"
#include "tests/property/synthetic.h"

// Depth images whose visibility has a closed form, and a checker that compares the reference with
// it.
namespace obscura::reference_scenes {

struct Vec {
  double x = 0, y = 0, z = 0;
  Vec operator+(Vec o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec operator-(Vec o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec operator*(double k) const { return {x * k, y * k, z * k}; }
};
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec unit(Vec a) { return a * (1 / std::sqrt(dot(a, a))); }

// The part of a convex polygon where inside(v) >= 0, `inside` being linear.
template <class Point, class F>
std::vector<Point> clip(const std::vector<Point>& polygon, F inside) {
  std::vector<Point> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double fa = inside(a), fb = inside(b);
    if (fa >= 0) out.push_back(a);
    if ((fa > 0 && fb < 0) || (fa < 0 && fb > 0)) out.push_back(a + (b - a) * (fa / (fa - fb)));
  }
  return out;
}

// Lambert: the cosine-weighted share of the hemisphere about n at p that a polygon covers.
inline double form_factor(Vec p, Vec n, const std::vector<Vec>& polygon) {
  const auto visible = clip(polygon, [&](Vec v) { return dot(n, v - p); });
  Vec sum;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const Vec a = unit(visible[i] - p), b = unit(visible[(i + 1) % visible.size()] - p);
    const Vec c = cross(a, b);
    const double sine = std::sqrt(dot(c, c));
    if (sine > 0) sum = sum + c * (std::atan2(sine, dot(a, b)) / sine);
  }
  return std::abs(dot(n, sum)) / (2 * std::numbers::pi);
}

struct Scene {
  synthetic::Input input;
  std::vector<double> truth;  // of visible pixels; NaN where it is not known
};

// The inside of a convex room whose walls are planes n.P = offset (n unit, towards the inside),
// seen in perspective: of each wall the depth image holds a polygon, up to the image's border.
inline Scene room(int width, int height, const Camera& camera, GuardBand guard,
                  const std::vector<Vec>& normals, const std::vector<double>& offsets) {
  Scene scene;
  scene.input = {width, height, {}, {}, camera, guard};
  const int walls = static_cast<int>(normals.size());
  // 1/depth of a wall at lattice coordinates; the wall that a view ray meets has the greatest.
  auto ray = [&](double x, double y) {
    return Vec{(x + 0.5 - camera.center_u) * camera.scale_x,
               (camera.center_v - y - 0.5) * camera.scale_y, -1};
  };
  auto height_of = [&](int wall, double x, double y) {
    return dot(normals[wall], ray(x, y)) / offsets[wall];
  };
  std::vector<std::vector<Vec>> polygons;
  for (int wall = 0; wall < walls; ++wall) {
    std::vector<Vec> seen = {
        {0, 0, 0}, {width - 1.0, 0, 0}, {width - 1.0, height - 1.0, 0}, {0, height - 1.0, 0}};
    for (int other = 0; other < walls; ++other) {
      if (other == wall) continue;
      seen =
          clip(seen, [&](Vec v) { return height_of(wall, v.x, v.y) - height_of(other, v.x, v.y); });
    }
    for (Vec& v : seen) v = ray(v.x, v.y) * (1 / height_of(wall, v.x, v.y));
    polygons.push_back(seen);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int wall = 0;
      for (int k = 1; k < walls; ++k) {
        if (height_of(k, x, y) > height_of(wall, x, y)) wall = k;
      }
      scene.input.depth.push_back(static_cast<float>(1 / height_of(wall, x, y)));
      const Vec n = normals[wall];
      for (const double v : {n.x, n.y, n.z}) scene.input.normals.push_back(static_cast<float>(v));
      if (x < guard.left || x >= width - guard.right || y < guard.top || y >= height - guard.bottom)
        continue;
      const Vec p = ray(x, y) * (1 / height_of(wall, x, y));
      double truth = 1;
      bool at_edge = false;
      for (int k = 0; k < walls; ++k) {
        if (k == wall) continue;
        truth -= form_factor(p, n, polygons[k]);
        // Cells that an edge crosses are rounded by the bilinear surface: stay two pixels away.
        for (const double dx : {-2.0, 2.0}) {
          for (const double dy : {-2.0, 2.0}) {
            at_edge |= height_of(k, x + dx, y + dy) > height_of(wall, x + dx, y + dy);
          }
        }
      }
      scene.truth.push_back(at_edge ? std::nan("") : truth);
    }
  }
  return scene;
}

// Seen from straight above by a parallel camera with square pixels: z = height(x, y) in units of
// the image's half width, with its slope, and the truth (NaN: not known).
template <class Height, class Truth>
Scene from_above(int size, GuardBand guard, Height height, Truth truth) {
  Scene scene;
  Camera camera;
  camera.orthographic = true;
  camera.scale_x = camera.scale_y = 2.0f / static_cast<float>(size);
  camera.center_u = camera.center_v = 0.5f * static_cast<float>(size);
  scene.input = {size, size, {}, {}, camera, guard};
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double x = (i + 0.5) * 2 / size - 1, y = 1 - (j + 0.5) * 2 / size;
      Vec normal{0, 0, 1};
      scene.input.depth.push_back(static_cast<float>(4 - height(x, y, &normal)));
      for (const double v : {normal.x, normal.y, normal.z}) {
        scene.input.normals.push_back(static_cast<float>(v));
      }
      if (i >= guard.left && i < size - guard.right && j >= guard.top && j < size - guard.bottom) {
        scene.truth.push_back(truth(x, y));
      }
    }
  }
  return scene;
}

struct Difference {
  int pixels = 0;
  double bias = 0, rms = 0, stated = 0;  // stated: root mean square of the standard errors
};

// Traces and compares where both truth and result are known.
inline Status compare(const Scene& scene, const ReferenceSettings& settings, Difference* result) {
  const DepthField field = scene.input.field();
  const int w = field.visible().width, h = field.visible().height;
  std::vector<float> visibility(scene.truth.size()), error(scene.truth.size());
  Outputs outputs;
  outputs.visibility = {visibility.data(), w, h};
  outputs.standard_error = {error.data(), w, h};
  if (Status s = compute(field, settings, outputs); !s.ok()) return s;
  *result = {};
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const double d = visibility[i] - scene.truth[i];
    if (std::isnan(d)) continue;
    ++result->pixels;
    result->bias += d;
    result->rms += d * d;
    result->stated += error[i] * error[i];
  }
  result->bias /= result->pixels;
  result->rms = std::sqrt(result->rms / result->pixels);
  result->stated = std::sqrt(result->stated / result->pixels);
  return {};
}

// The thresholds for closed forms with 4,096 rays.
constexpr double kBias = 0.001, kRms = 0.005;
inline bool agrees(const Difference& d) {
  return d.pixels > 0 && std::abs(d.bias) <= kBias && d.rms <= kRms;
}

}  // namespace obscura::reference_scenes

#endif  // OBSCURA_TESTS_PROPERTY_REFERENCE_SCENES_H_
