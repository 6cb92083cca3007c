#ifndef OBSCURA_TESTS_REFERENCE_VOLUME_LOOPS_H_
#define OBSCURA_TESTS_REFERENCE_VOLUME_LOOPS_H_

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// Sweeps as plain loops in floats, on cubes with a border, to compare speeds with.
namespace obscura::reference {

inline float eikonal_cube(float a, float b, float c) {
  const float low = std::min(a, b), high = std::max(a, b), least = std::min(low, c);
  const float most = std::max(high, c), middle = std::max(low, std::min(high, c));
  const float e1 = middle - least, e2 = most - least;
  if (e1 >= 1) return least + 1;
  const float two = 0.5f * (e1 + std::sqrt(2 - e1 * e1));
  if (two <= e2) return least + two;
  const float q = e1 + e2;
  return least + (q + std::sqrt(std::max(0.0f, q * q - 3 * (e1 * e1 + e2 * e2 - 1)))) / 3;
}

// `d` holds |D| in voxels of (n + 2)^3 with a border of large values; eight sweeps of Table 1.
inline void sweep_distance_loops(std::vector<float>& d, int n) {
  const std::ptrdiff_t py = n + 2, pz = py * py;
  for (int s = 0; s < 8; ++s) {
    const int dx = s & 1 ? -1 : 1, dy = s & 2 ? -1 : 1, dz = s & 4 ? -1 : 1;
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        float* row = d.data() + (dz > 0 ? k + 1 : n - k) * pz + (dy > 0 ? j + 1 : n - j) * py;
        for (int i = 0; i < n; ++i) {
          float* p = row + (dx > 0 ? i + 1 : n - i);
          *p = std::min(*p, eikonal_cube(p[-dx], p[-dy * py], p[-dz * pz]));
        }
      }
    }
  }
}

// Equation 6 for all octants; `w` is scratch of (n + 2)^3, `v` is n^3 voxels of eight floats.
inline void sweep_octants_loops(const std::vector<std::uint8_t>& tau, int n, std::vector<float>& w,
                                std::vector<float>& v) {
  const std::ptrdiff_t py = n + 2, pz = py * py;
  for (int s = 0; s < 8; ++s) {
    std::fill(w.begin(), w.end(), 1.0f);
    const int dx = s & 1 ? -1 : 1, dy = s & 2 ? -1 : 1, dz = s & 4 ? -1 : 1;
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const int x = dx > 0 ? i : n - 1 - i, y = dy > 0 ? j : n - 1 - j;
          const int z = dz > 0 ? k : n - 1 - k;
          const std::size_t at = x + std::size_t(n) * (y + std::size_t(n) * z);
          float* p = w.data() + (z + 1) * pz + (y + 1) * py + x + 1;
          const float mean = (p[-dx] + p[-dy * py] + p[-dz * pz]) * (1.0f / 3);
          v[8 * at + s] = mean;
          *p = mean * tau[at] * (1.0f / 255);
        }
      }
    }
  }
}

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_VOLUME_LOOPS_H_
