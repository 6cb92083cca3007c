#ifndef OBSCURA_TESTS_REFERENCE_AREA_H_
#define OBSCURA_TESTS_REFERENCE_AREA_H_

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/reflection_noise.h"
#include "obscura/area.h"
#include "obscura/patterns.h"
#include "tests/reference/volumetric.h"
#include "view/geometry.h"

namespace obscura::reference {

// Area sampling, implemented independently: pixel by pixel in double precision, with sums over all
// texels under a kernel instead of a pyramid, for the depth image and for the tangent plane, and by
// quadrature of the visibility that falls from 1 at mu - sigma to 0 at mu + sigma.
class Area {
 public:
  Area(const view::Geometry& geometry, const AreaSettings& settings,
       std::span<const DiskSample> samples, int level_count)
      : g(geometry), s(settings), pattern(samples), last(level_count - 1), noise(settings.seed) {
    std::vector<double> kernel = {1};
    for (int l = 0; l <= last; ++l) {
      kernels.push_back(kernel);
      // The binomial with its taps 2^l pixels apart.
      std::vector<double> next(kernel.size() + (4u << l), 0.0);
      constexpr double kBinomial[5] = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
      for (std::size_t i = 0; i < kernel.size(); ++i) {
        for (std::size_t k = 0; k < 5; ++k) next[i + (k << l)] += kernel[i] * kBinomial[k];
      }
      kernel = next;
    }
  }

  // Of visible pixel (px, py).
  double visibility(int px, int py) const {
    const int x = px + g.guard_band.left, y = py + g.guard_band.top;
    const double z = g.depth(x, y), radius = s.falloff.radius;
    if (!std::isfinite(z)) return 1;
    const Camera& c = g.camera;
    const float distance = c.orthographic ? 1.0f : static_cast<float>(z);
    const float reach_x = s.falloff.radius / c.scale_x / distance;
    const float reach_y = s.falloff.radius / c.scale_y / distance;
    const int tile = ReflectionNoise::kSize;
    const float cosine = noise.x()[py % tile * tile + px % tile];
    const float sine = noise.y()[py % tile * tile + px % tile];
    const Plane plane = tangent_plane(x, y);
    double open = 0, whole = 0;
    for (const DiskSample& p : pattern) {
      const double lateral = std::hypot(p.x, p.y), zs = std::sqrt(1 - lateral * lateral);
      const double sx = s.rotate ? cosine * p.x + sine * p.y : p.x;
      const double sy = s.rotate ? sine * p.x - cosine * p.y : p.y;
      const int i = static_cast<int>(std::clamp(x + nearest(reach_x * sx), 0LL, g.width - 1LL));
      const int j = static_cast<int>(std::clamp(y + nearest(reach_y * sy), 0LL, g.height - 1LL));

      // The level whose kernel has the deviation of the sample's cell, and whose successor fits
      // into the image and before half the way to the plane's horizon.
      const double cell = p.weight_constant / (2 * zs);
      const double wanted = 0.5 * std::log2(static_cast<double>(reach_x) * reach_y * 3 * cell /
                                            (4 * std::numbers::pi));
      const double border = std::min({i, j, g.width - 1 - i, g.height - 1 - j});
      const double room = std::max(0.0, std::min(border, 0.5 * to_horizon(i, j, plane)));
      const int octave = static_cast<int>(std::log2(room + 2));
      const double fits = octave + (room + 2.0) / (1 << octave) - 1 - 2;
      const double level = std::clamp(wanted, 0.0, std::max(0.0, std::min<double>(fits, last)));
      const int fine = static_cast<int>(level);
      const double blend = level - fine;
      const int step = 1 << std::max(0, fine - 1);
      auto snap = [&](int at, float direction) {
        const float digits = direction * 64.0f - std::nearbyint(direction * 64.0f);
        const int moved = s.rotate ? at + static_cast<int>(nearest(digits * step)) : at;
        return (moved + step / 2) / step * step;
      };
      const int u = snap(i, cosine), v = snap(j, sine);

      const Moments seen = mix(moments(fine, u, v, false, plane),
                               moments(std::min(fine + 1, last), u, v, false, plane), blend);
      const double mu = (seen.mean - z) / radius, sigma = seen.deviation / radius;
      const bool quadratic = s.falloff.kind == FalloffKind::kQuadratic;
      auto line = [&](double at, double width) {
        return free_part(quadratic, lateral, zs, at, std::max(width, 1e-3));
      };
      const double all = rho_integral(quadratic, lateral, -zs, zs);
      double bound = all;
      if (g.has_normals) {
        const Moments flat = mix(moments(fine, u, v, true, plane),
                                 moments(std::min(fine + 1, last), u, v, true, plane), blend);
        bound = line((flat.mean - z) / radius, flat.deviation / radius);
      }
      double free = std::min(line(mu, sigma), bound);
      if (s.occluder.kind == OccluderKind::kThickness) {
        const double perspective = c.orthographic ? 0 : 1;
        const double ta = perspective * (i + 0.5 - c.center_u) * c.scale_x;
        const double tb = perspective * (c.center_v - j - 0.5) * c.scale_y;
        const double behind = s.occluder.thickness / std::sqrt(1 + ta * ta + tb * tb) / radius;
        free += bound - std::min(line(mu + behind, sigma), bound);
      }
      const double weight = (quadratic ? p.weight_quadratic : p.weight_constant) / all;
      open += weight * (bound + seen.share * (free - bound));
      whole += weight * (g.has_normals ? bound : all);
    }
    return whole > 0 ? open / whole : 1;
  }

 private:
  struct Plane {
    double nx = 0, ny = 0, nz = 1, level = 0;  // n.P = level
  };
  struct Moments {
    double mean, deviation, share;
  };

  void ray(int i, int j, double* ox, double* oy, double* a, double* b) const {
    const Camera& c = g.camera;
    const double u = (i + 0.5 - c.center_u) * c.scale_x, v = (c.center_v - j - 0.5) * c.scale_y;
    *ox = c.orthographic ? u : 0;
    *oy = c.orthographic ? v : 0;
    *a = c.orthographic ? 0 : u;
    *b = c.orthographic ? 0 : v;
  }

  Plane tangent_plane(int x, int y) const {
    Plane p;
    if (!g.has_normals) return p;
    p = {g.normal_x(x, y), g.normal_y(x, y), g.normal_z(x, y)};
    double ox, oy, a, b;
    ray(x, y, &ox, &oy, &a, &b);
    const double facing = p.nx * a + p.ny * b - p.nz;
    if (facing > -1e-4) {
      const double k = (facing + 1e-4) / (1 + a * a + b * b);
      p.nx -= k * a;
      p.ny -= k * b;
      p.nz += k;
    }
    const double z = g.depth(x, y);
    p.level = p.nx * (ox + z * a) + p.ny * (oy + z * b) - p.nz * z;
    return p;
  }

  // Pixels from texel (i, j) to the line where rays are parallel to the plane.
  double to_horizon(int i, int j, const Plane& plane) const {
    if (!g.has_normals || g.camera.orthographic) return std::numeric_limits<double>::infinity();
    double ox, oy, a, b;
    ray(i, j, &ox, &oy, &a, &b);
    return -(plane.nx * a + plane.ny * b - plane.nz) /
           std::hypot(plane.nx * g.camera.scale_x, plane.ny * g.camera.scale_y);
  }

  // Of the depths, or of the tangent plane's, under level `level`'s kernel at texel (u, v).
  Moments moments(int level, int u, int v, bool of_plane, const Plane& plane) const {
    const std::vector<double>& kernel = kernels[level];
    const int reach = static_cast<int>(kernel.size() / 2);
    double share = 0, first = 0, second = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const int i = u + dx, j = v + dy;
        double depth;
        if (of_plane) {
          double ox, oy, a, b;
          ray(i, j, &ox, &oy, &a, &b);
          depth = (plane.level - plane.nx * ox - plane.ny * oy) /
                  (plane.nx * a + plane.ny * b - plane.nz);
        } else {
          if (i < 0 || j < 0 || i >= g.width || j >= g.height) continue;
          depth = g.depth(i, j);
          if (!std::isfinite(depth)) continue;
        }
        const double weight = kernel[dx + reach] * kernel[dy + reach];
        share += weight;
        first += weight * depth;
        second += weight * depth * depth;
      }
    }
    if (share == 0) return {0, 0, 0};
    const double mean = first / share;
    return {mean, std::sqrt(std::max(0.0, second / share - mean * mean)), share};
  }

  // Between two levels; where the finer sees background only, the coarser stands in.
  static Moments mix(Moments a, const Moments& b, double t) {
    if (a.share == 0) a = {b.mean, b.deviation, 0};
    return {a.mean + t * (b.mean - a.mean), a.deviation + t * (b.deviation - a.deviation),
            a.share + t * (b.share - a.share)};
  }

  // Integral of rho times the visibility over the sample's line. By parts, it is the mean over the
  // depths between mu - sigma and mu + sigma of the integral up to there.
  static double free_part(bool quadratic, double lateral, double zs, double mu, double sigma) {
    constexpr int kSteps = 64;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double at = mu + sigma * (2 * (i + 0.5) / kSteps - 1);
      sum += rho_integral(quadratic, lateral, -zs, std::clamp(at, -zs, zs));
    }
    return sum / kSteps;
  }

  const view::Geometry& g;
  const AreaSettings s;
  const std::span<const DiskSample> pattern;
  const int last;
  const ReflectionNoise noise;
  std::vector<std::vector<double>> kernels;  // per level, along one axis
};

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_AREA_H_
