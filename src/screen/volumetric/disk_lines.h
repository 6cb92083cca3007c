#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_DISK_LINES_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_DISK_LINES_H_

#include <algorithm>
#include <cmath>
#include <span>

#include "math/sphere_line.h"
#include "obscura/patterns.h"

namespace obscura {

// The line of the unit sphere over a sample of the disk, as kernels of line and area samples want
// it; lengths along it are radii times `unit`.
struct DiskLine {
  float lateral;  // distance from the sphere's centre, in radii
  float extent;   // half its length
  float half;     // integral of rho over it
  float weight;   // w / sum w / (2 half)
};

inline double disk_weight(const DiskSample& s, bool quadratic) {
  return quadratic ? s.weight_quadratic : s.weight_constant;
}

inline double sum_of_weights(std::span<const DiskSample> pattern, bool quadratic) {
  double sum = 0;
  for (const DiskSample& s : pattern) sum += disk_weight(s, quadratic);
  return sum;
}

// `unit` is 1 where rho is quadratic: its integral knows radii only.
inline DiskLine disk_line(const DiskSample& s, bool quadratic, double unit, double weight_sum) {
  const double square = static_cast<double>(s.x) * s.x + static_cast<double>(s.y) * s.y;
  const double lateral = std::sqrt(square), extent = std::sqrt(1 - square);
  const double half = quadratic ? math::quadratic_line_integral(extent, lateral) : extent * unit;
  return {std::max(static_cast<float>(lateral), 1e-6f), static_cast<float>(extent * unit),
          static_cast<float>(half),
          static_cast<float>(disk_weight(s, quadratic) / weight_sum / (2 * half))};
}

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_DISK_LINES_H_
