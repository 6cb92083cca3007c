#ifndef OBSCURA_TESTS_REFERENCE_VOLUME_SWEEPS_H_
#define OBSCURA_TESTS_REFERENCE_VOLUME_SWEEPS_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

// Plain loops for what src/volume does with vectors, written from the equations only.
namespace obscura::reference {

struct Grid {
  std::array<int, 3> size{};
  std::array<float, 3> spacing{1, 1, 1};
  std::vector<float> v{};

  explicit Grid(std::array<int, 3> n, std::array<float, 3> h = {1, 1, 1}, float fill = 0)
      : size(n), spacing(h), v(std::size_t(n[0]) * n[1] * n[2], fill) {}
  std::size_t at(int x, int y, int z) const {
    return x + std::size_t(size[0]) * (y + std::size_t(size[1]) * z);
  }
  float& operator()(int x, int y, int z) { return v[at(x, y, z)]; }
  float operator()(int x, int y, int z) const { return v[at(x, y, z)]; }

  template <class F>
  void fill(const F& f) {
    for (int z = 0; z < size[2]; ++z) {
      for (int y = 0; y < size[1]; ++y) {
        for (int x = 0; x < size[0]; ++x) {
          (*this)(x, y, z) = static_cast<float>(f(x * spacing[0], y * spacing[1], z * spacing[2]));
        }
      }
    }
  }
};

// The smallest d with sum over the neighbours below it of ((d - a) / h)^2 = 1 (equation 1).
inline double solve_eikonal(std::array<double, 3> a, std::array<double, 3> h) {
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      if (a[k] > a[k + 1]) std::swap(a[k], a[k + 1]), std::swap(h[k], h[k + 1]);
    }
  }
  double best = std::numeric_limits<double>::infinity();
  double square = 0, linear = 0, constant = -1;
  for (int i = 0; i < 3 && a[i] < best; ++i) {
    const double e = a[i] - a[0], w = 1 / (h[i] * h[i]);
    square += w;
    linear += w * e;
    constant += w * e * e;
    const double root = std::max(0.0, linear * linear - square * constant);
    best = a[0] + (linear + std::sqrt(root)) / square;
  }
  return best;
}

// Sweeps |D| in the eight orders of Table 1, `rounds` times over; signs stay.
inline void sweep_distance(Grid& d, int rounds) {
  const int nx = d.size[0], ny = d.size[1], nz = d.size[2];
  const double far = 1e30;
  auto at = [&](int x, int y, int z) {
    const bool in = x >= 0 && x < nx && y >= 0 && y < ny && z >= 0 && z < nz;
    return in ? std::fabs(double{d(x, y, z)}) : far;
  };
  for (int s = 0; s < 8 * rounds; ++s) {
    const int sx = s & 1 ? -1 : 1, sy = s & 2 ? -1 : 1, sz = s & 4 ? -1 : 1;
    for (int k = 0; k < nz; ++k) {
      const int z = sz > 0 ? k : nz - 1 - k;
      for (int j = 0; j < ny; ++j) {
        const int y = sy > 0 ? j : ny - 1 - j;
        for (int i = 0; i < nx; ++i) {
          const int x = sx > 0 ? i : nx - 1 - i;
          const double e = solve_eikonal({at(x - sx, y, z), at(x, y - sy, z), at(x, y, z - sz)},
                                         {d.spacing[0], d.spacing[1], d.spacing[2]});
          float& v = d(x, y, z);
          if (e < std::fabs(v)) v = std::copysign(static_cast<float>(e), v);
        }
      }
    }
  }
}

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_VOLUME_SWEEPS_H_
