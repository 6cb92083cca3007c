#include "screen/volumetric/patterns/voronoi.h"

#include <algorithm>
#include <cmath>

#include "math/sphere_line.h"

namespace obscura::math {

VoronoiGrid::VoronoiGrid(bool ball, int resolution) {
  const double h = 2.0 / resolution;
  auto middle = [h](int i) { return -1 + (i + 0.5) * h; };
  for (int k = 0; k < (ball ? resolution : 1); ++k) {
    const double z = ball ? middle(k) : 0;
    for (int j = 0; j < resolution; ++j) {
      for (int i = 0; i < resolution; ++i) {
        const double x = middle(i), y = middle(j);
        const double square = x * x + y * y + z * z;
        if (square >= 1) continue;
        const double r = std::sqrt(square), half = std::sqrt(1 - square);
        x_.push_back(static_cast<float>(x));
        y_.push_back(static_cast<float>(y));
        z_.push_back(static_cast<float>(z));
        constant_.push_back(static_cast<float>(ball ? h * h * h : 2 * half * h * h));
        quadratic_.push_back(static_cast<float>(
            ball ? (1 - r) * (1 - r) * h * h * h : 2 * quadratic_line_integral(half, r) * h * h));
      }
    }
  }
}

std::vector<VoronoiCell> VoronoiGrid::cells(std::span<const Point> points) const {
  std::vector<VoronoiCell> cells(points.size());
  constexpr std::size_t kChunk = 512;
  float best[kChunk];
  int nearest[kChunk];
  for (std::size_t start = 0; start < x_.size(); start += kChunk) {
    const std::size_t count = std::min(kChunk, x_.size() - start);
    const float *x = &x_[start], *y = &y_[start], *z = &z_[start];
    std::fill_n(best, count, 1e9f);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const float px = static_cast<float>(points[p][0]), py = static_cast<float>(points[p][1]),
                  pz = static_cast<float>(points[p][2]);
      const int id = static_cast<int>(p);
      for (std::size_t i = 0; i < count; ++i) {
        const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
        const float distance = dx * dx + dy * dy + dz * dz;
        const bool closer = distance < best[i];
        best[i] = closer ? distance : best[i];
        nearest[i] = closer ? id : nearest[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      VoronoiCell& cell = cells[nearest[i]];
      const double w = constant_[start + i];
      cell.constant += w;
      cell.quadratic += quadratic_[start + i];
      cell.centroid[0] += w * x[i];
      cell.centroid[1] += w * y[i];
      cell.centroid[2] += w * z[i];
    }
  }
  for (VoronoiCell& c : cells) {
    for (double& v : c.centroid) v = c.constant > 0 ? v / c.constant : 0;
  }
  return cells;
}

}  // namespace obscura::math
