#ifndef OBSCURA_SRC_MATH_DISK_PATTERN_H_
#define OBSCURA_SRC_MATH_DISK_PATTERN_H_

#include <vector>

namespace obscura {

// A sample of the unit disk, the projection of the unit sphere along the view direction. The
// weights are the integrals, over the sample's Voronoi cell in the disk, of the line integral of
// rho through the sphere: rho = 1, and rho = (1 - r)^2. Over a pattern they sum to the whole
// integrals, 4 pi / 3 and 2 pi / 15.
struct DiskSample {
  float x, y;
  float weight_constant;
  float weight_quadratic;
};

// `count` samples in [1, 32], the same ones for the same count.
std::vector<DiskSample> disk_pattern(int count);

}  // namespace obscura

#endif  // OBSCURA_SRC_MATH_DISK_PATTERN_H_
