#include "math/disk_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sphere_line.h"

namespace obscura {
namespace {

struct Moments {
  double weight = 0, x = 0, y = 0, quadratic = 0;
};

// Integrals of the sphere's extent over each sample's Voronoi cell, on a grid of cells^2.
std::vector<Moments> voronoi_moments(const std::vector<DiskSample>& samples, int cells) {
  std::vector<Moments> moments(samples.size());
  const double h = 2.0 / cells;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const double x = -1 + (i + 0.5) * h, y = -1 + (j + 0.5) * h;
      const double square = x * x + y * y;
      if (square >= 1) continue;
      std::size_t nearest = 0;
      double best = 9;
      for (std::size_t s = 0; s < samples.size(); ++s) {
        const double dx = samples[s].x - x, dy = samples[s].y - y;
        const double distance = dx * dx + dy * dy;
        if (distance < best) {
          best = distance;
          nearest = s;
        }
      }
      const double half = std::sqrt(1 - square);
      Moments& m = moments[nearest];
      m.weight += 2 * half * h * h;
      m.x += 2 * half * h * h * x;
      m.y += 2 * half * h * h * y;
      m.quadratic += 2 * math::quadratic_line(half, std::sqrt(square)) * h * h;
    }
  }
  return moments;
}

}  // namespace

std::vector<DiskSample> disk_pattern(int count) {
  std::vector<DiskSample> samples(count);
  for (int i = 0; i < count; ++i) {
    const double r = std::sqrt((i + 0.5) / count),
                 angle = i * (3 - std::sqrt(5.0)) * std::numbers::pi;
    samples[i].x = static_cast<float>(r * std::cos(angle));
    samples[i].y = static_cast<float>(r * std::sin(angle));
  }
  // Lloyd's relaxation towards the centroids, weighted by the sphere's extent.
  constexpr int kSteps = 30, kCoarse = 96, kFine = 384;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<Moments> moments = voronoi_moments(samples, kCoarse);
    for (int i = 0; i < count; ++i) {
      samples[i].x = static_cast<float>(moments[i].x / moments[i].weight);
      samples[i].y = static_cast<float>(moments[i].y / moments[i].weight);
    }
  }
  const std::vector<Moments> moments = voronoi_moments(samples, kFine);
  for (int i = 0; i < count; ++i) {
    samples[i].weight_constant = static_cast<float>(moments[i].weight);
    samples[i].weight_quadratic = static_cast<float>(moments[i].quadratic);
  }
  return samples;
}

}  // namespace obscura
