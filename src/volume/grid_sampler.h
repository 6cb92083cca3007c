#ifndef OBSCURA_SRC_VOLUME_GRID_SAMPLER_H_
#define OBSCURA_SRC_VOLUME_GRID_SAMPLER_H_

#include <algorithm>
#include <cmath>

#include "obscura/volume.h"

namespace obscura {

using Vec3 = std::array<float, 3>;

// Trilinear look-up in a grid of floats at grid-space positions.
class GridSampler {
 public:
  explicit GridSampler(const GridView<const float>& grid) : GridSampler(grid, 0, grid.size[2]) {}
  // Of planes from `first` on of a grid with so many.
  GridSampler(const GridView<const float>& grid, int first, int depth)
      : data_(grid.data),
        stride_(grid.strides()),
        size_{grid.size[0], grid.size[1], depth},
        first_(first),
        planes_(grid.size[2]) {
    for (int a = 0; a < 3; ++a) {
      per_spacing_[a] = 1 / grid.spacing[a];
      last_[a] = static_cast<float>(size_[a] - 1);
      step_[a] = size_[a] > 1 ? stride_[a] : 0;
      most_[a] = std::max(0, size_[a] - 2);
    }
  }

  // Whether a position lies within the outermost voxels' centres. An axis of a single voxel has no
  // extent, so half a voxel on either side counts as inside.
  bool inside(const Vec3& p) const {
    for (int a = 0; a < 3; ++a) {
      const float u = p[a] * per_spacing_[a];
      const float margin = size_[a] == 1 ? 0.5f : 0.0f;
      if (!(u >= -margin && u <= last_[a] + margin)) return false;
    }
    return true;
  }

  // Whether the planes on both sides of a position are among those that it has.
  bool has(const Vec3& p) const {
    const int k = below(clamped(p, 2), 2) - first_;
    return k >= 0 && k + (size_[2] > 1 ? 1 : 0) < planes_;
  }

  // Positions outside take the value at the nearest position inside.
  float operator()(const Vec3& p) const {
    const float* at = data_;
    float f[3];
    for (int a = 0; a < 3; ++a) {
      const float u = clamped(p, a);
      const int i = below(u, a);
      f[a] = u - static_cast<float>(i);
      at += (a == 2 ? i - first_ : i) * stride_[a];
    }
    auto line = [&](const float* q) { return q[0] + f[0] * (q[step_[0]] - q[0]); };
    auto square = [&](const float* q) {
      const float low = line(q);
      return low + f[1] * (line(q + step_[1]) - low);
    };
    const float low = square(at);
    return low + f[2] * (square(at + step_[2]) - low);
  }

 private:
  float clamped(const Vec3& p, int a) const {
    return std::min(std::max(p[a] * per_spacing_[a], 0.0f), last_[a]);
  }
  int below(float u, int a) const { return std::min(static_cast<int>(u), most_[a]); }

  const float* data_;
  std::array<std::ptrdiff_t, 3> stride_;
  std::array<int, 3> size_;
  int first_, planes_;
  float per_spacing_[3], last_[3];
  std::ptrdiff_t step_[3];
  int most_[3];
};

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_GRID_SAMPLER_H_
