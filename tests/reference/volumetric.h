#ifndef OBSCURA_TESTS_REFERENCE_VOLUMETRIC_H_
#define OBSCURA_TESTS_REFERENCE_VOLUMETRIC_H_

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/reflection_noise.h"
#include "obscura/line.h"
#include "obscura/patterns.h"
#include "obscura/point.h"
#include "view/geometry.h"

// Volumetric obscurance, implemented independently: pixel by pixel in double precision, the tangent
// plane by intersecting rays, rho by quadrature. The kernels are compared with it.
namespace obscura::reference {

// Integral of rho along a line at distance `lateral` from the centre, from lo to hi (unit sphere).
inline double rho_integral(bool quadratic, double lateral, double lo, double hi) {
  if (!quadratic || hi <= lo) return std::max(0.0, hi - lo);
  // Simpson's rule on both sides of the kink at z = 0 that lines through the centre have.
  auto piece = [&](double a, double b) {
    constexpr int kSteps = 32;
    double sum = 0;
    const double h = (b - a) / kSteps;
    for (int i = 0; i <= kSteps; ++i) {
      const double z = a + i * h, r = std::min(1.0, std::sqrt(lateral * lateral + z * z));
      sum += (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) * (1 - r) * (1 - r);
    }
    return sum * h / 3;
  };
  if (lo < 0 && hi > 0) return piece(lo, 0) + piece(0, hi);
  return piece(lo, hi);
}

// Round to nearest, ties to even.
inline long long nearest(double v) { return std::llrint(std::clamp(v, -131072.0, 131072.0)); }

// Line sampling. Reach is computed in float as the kernel does, so that both fetch the same texels
// but for the rarest ties.
class Line {
 public:
  Line(const view::Geometry& geometry, const LineSettings& settings,
       std::span<const DiskSample> samples)
      : g(geometry), s(settings), pattern(samples), noise(settings.seed) {}

  // Of visible pixel (px, py).
  double visibility(int px, int py) const {
    const int x = px + g.guard_band.left, y = py + g.guard_band.top;
    const double z = g.depth(x, y), radius = s.falloff.radius;
    if (!std::isfinite(z)) return 1;
    const bool quadratic = s.falloff.kind == FalloffKind::kQuadratic;
    const Camera& c = g.camera;
    const double perspective = c.orthographic ? 0 : 1;
    struct Ray {
      double a, b;  // direction (a, b, -1) through (x, y) at depth 0
      double x, y;
    };
    auto ray = [&](long long i, long long j) {
      const double u = (i + 0.5 - c.center_u) * c.scale_x, v = (c.center_v - j - 0.5) * c.scale_y;
      return c.orthographic ? Ray{0, 0, u, v} : Ray{u, v, 0, 0};
    };
    const Ray r0 = ray(x, y);
    double nx = 0, ny = 0, nz = 0;
    if (g.has_normals) {
      nx = g.normal_x(x, y);
      ny = g.normal_y(x, y);
      nz = g.normal_z(x, y);
      const double facing = nx * r0.a + ny * r0.b - nz;
      if (facing > -1e-4) {
        const double k = (facing + 1e-4) / (1 + r0.a * r0.a + r0.b * r0.b);
        nx -= k * r0.a;
        ny -= k * r0.b;
        nz += k;
      }
    }
    const float distance = c.orthographic ? 1.0f : static_cast<float>(z);
    const float reach_x = s.falloff.radius / c.scale_x / distance;
    const float reach_y = s.falloff.radius / c.scale_y / distance;
    const int tile = ReflectionNoise::kSize;
    const double cosine = noise.x()[py % tile * tile + px % tile];
    const double sine = noise.y()[py % tile * tile + px % tile];
    double weights = 0, open = 0, whole = 0;
    for (const DiskSample& p : pattern) {
      const double lateral = std::hypot(p.x, p.y);
      const double zs = std::sqrt(1 - lateral * lateral);
      const double sx = s.rotate ? cosine * p.x + sine * p.y : p.x;
      const double sy = s.rotate ? sine * p.x - cosine * p.y : p.y;
      const long long i = std::clamp(x + nearest(reach_x * sx), 0LL, g.width - 1LL);
      const long long j = std::clamp(y + nearest(reach_y * sy), 0LL, g.height - 1LL);
      const Ray r = ray(i, j);
      const double d = (g.depth(int(i), int(j)) - z) / radius;
      double zu = zs;
      if (g.has_normals) {
        // Plane n.(P - P0) = 0 with P = (r.x, r.y, 0) + t (r.a, r.b, -1).
        const double ox = r0.x + z * r0.a, oy = r0.y + z * r0.b;
        const double divisor = nx * r.a + ny * r.b - nz;
        const double t = (nx * (ox - r.x) + ny * (oy - r.y) - nz * z) / divisor;
        if (divisor < 0) zu = std::clamp((t - z) / radius, -zs, zs);
      }
      auto line = [&](double lo, double hi) { return rho_integral(quadratic, lateral, lo, hi); };
      const double weight = (quadratic ? p.weight_quadratic : p.weight_constant) / line(-zs, zs);
      double free = line(-zs, std::clamp(d, -zs, zu));
      if (s.occluder.kind == OccluderKind::kThickness) {
        const double thickness =
            s.occluder.thickness / std::sqrt(1 + perspective * (r.a * r.a + r.b * r.b)) / radius;
        free += line(std::clamp(d + thickness, -zs, zu), zu);
      }
      weights += weight * line(-zs, zs);
      open += weight * free;
      whole += weight * line(-zs, zu);
    }
    if (!g.has_normals) return open / weights;
    return whole > 0 ? open / whole : 1;
  }

 private:
  const view::Geometry& g;
  const LineSettings s;
  const std::span<const DiskSample> pattern;
  const ReflectionNoise noise;
};

// Point sampling with a fixed pattern in the ball, along the way of the definition: the sample at
// the texel's own ray and at its height above the tangent plane is tested by depth.
class Point {
 public:
  Point(const view::Geometry& geometry, const PointSettings& settings,
        std::span<const BallSample> samples)
      : g(geometry), s(settings), pattern(samples), noise(settings.seed, true) {}

  // Of visible pixel (px, py).
  double visibility(int px, int py) const {
    const int x = px + g.guard_band.left, y = py + g.guard_band.top;
    const double z = g.depth(x, y), radius = s.falloff.radius;
    if (!std::isfinite(z)) return 1;
    const Camera& c = g.camera;
    const bool quadratic = s.falloff.kind == FalloffKind::kQuadratic;
    auto ray = [&](long long i, long long j, double* a, double* b) {
      *a = c.orthographic ? 0 : (i + 0.5 - c.center_u) * c.scale_x;
      *b = c.orthographic ? 0 : (c.center_v - j - 0.5) * c.scale_y;
    };
    double a, b, nx = 0, ny = 0, nz = 0;
    ray(x, y, &a, &b);
    if (g.has_normals) {
      nx = g.normal_x(x, y);
      ny = g.normal_y(x, y);
      nz = g.normal_z(x, y);
      const double facing = nx * a + ny * b - nz;
      if (facing > -1e-4) {
        const double k = (facing + 1e-4) / (1 + a * a + b * b);
        nx -= k * a;
        ny -= k * b;
        nz += k;
      }
    }
    const float distance = c.orthographic ? 1.0f : static_cast<float>(z);
    const float reach_x = s.falloff.radius / c.scale_x / distance;
    const float reach_y = s.falloff.radius / c.scale_y / distance;
    const int at =
        py % ReflectionNoise::kSize * ReflectionNoise::kSize + px % ReflectionNoise::kSize;
    double weights = 0, free = 0;
    for (const BallSample& p : pattern) {
      double sx = p.x, sy = p.y, sz = p.z;
      auto reflect = [&](double k, double vx, double vy, double vz) {
        sx -= 2 * k * vx;
        sy -= 2 * k * vy;
        sz -= 2 * k * vz;
      };
      if (s.rotate) {
        const double vx = noise.x()[at], vy = noise.y()[at], vz = noise.z()[at];
        reflect(sx * vx + sy * vy + sz * vz, vx, vy, vz);
      }
      if (g.has_normals) reflect(std::min(0.0, sx * nx + sy * ny + sz * nz), nx, ny, nz);
      const long long i = std::clamp(x + nearest(reach_x * sx), 0LL, g.width - 1LL);
      const long long j = std::clamp(y - nearest(reach_y * sy), 0LL, g.height - 1LL);
      const double depth = g.depth(int(i), int(j));
      double sample = z - sz * radius, ta, tb;  // its depth
      ray(i, j, &ta, &tb);
      if (g.has_normals) {
        // n.(P - P0) = h with P = (ox, oy, 0) + t (ta, tb, -1), P0 = z (a, b, -1).
        const double height = (sx * nx + sy * ny + sz * nz) * radius + 1e-6 * z;
        const double ox = c.orthographic ? (i - x) * double(c.scale_x) : 0;
        const double oy = c.orthographic ? (y - j) * double(c.scale_y) : 0;
        const double slope = nx * ta + ny * tb - nz;
        sample = (height + z * (nx * a + ny * b - nz) - nx * ox - ny * oy) / slope;
      }
      bool inside = sample > depth;
      if (s.occluder.kind == OccluderKind::kThickness) {
        inside =
            inside && sample <= depth + s.occluder.thickness / std::sqrt(1 + ta * ta + tb * tb);
      }
      const double weight = quadratic ? p.weight_quadratic : p.weight_constant;
      weights += weight;
      free += inside ? 0 : weight;
    }
    return free / weights;
  }

 private:
  const view::Geometry& g;
  const PointSettings s;
  const std::span<const BallSample> pattern;
  const ReflectionNoise noise;
};

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_VOLUMETRIC_H_
