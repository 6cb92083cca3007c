#ifndef OBSCURA_TESTS_REFERENCE_TERRAIN_H_
#define OBSCURA_TESTS_REFERENCE_TERRAIN_H_

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "obscura/terrain.h"

// Elevation models made from formulas, and what their cells see, marched in small steps.
namespace obscura::reference {

struct Model {
  int width = 0, height = 0;
  std::vector<float> heights;
  double cell_width = 1, cell_height = 1;

  Model(int w, int h, double cw = 1, double ch = 1)
      : width(w), height(h), heights(std::size_t(w) * h), cell_width(cw), cell_height(ch) {}

  float& operator()(int x, int y) { return heights[std::size_t(y) * width + x]; }
  float operator()(int x, int y) const { return heights[std::size_t(y) * width + x]; }
  // f(east, north) of the cells' centres, from the middle cell.
  void fill(const std::function<double(double, double)>& f) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        (*this)(x, y) = float(f((x - width / 2) * cell_width, (height / 2 - y) * cell_height));
      }
    }
  }
  ElevationModel view() const {
    return {{heights.data(), width, height}, cell_width, cell_height, {}};
  }
  // Bilinear between the cells' centres.
  double at(double x, double y) const {
    const int i = std::clamp(int(std::floor(x)), 0, std::max(0, width - 2));
    const int j = std::clamp(int(std::floor(y)), 0, std::max(0, height - 2));
    const double fx = x - i, fy = y - j;
    const int i1 = std::min(i + 1, width - 1), j1 = std::min(j + 1, height - 1);
    const auto& m = *this;
    return (1 - fy) * ((1 - fx) * m(i, j) + fx * m(i1, j)) +
           fy * ((1 - fx) * m(i, j1) + fx * m(i1, j1));
  }
};

// Hash noise in [0, 1).
inline double hash01(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (h ^ (h >> 15)) / 4294967296.0;
}

// Mountains: octaves of smooth noise; `rough` is the ratio of amplitudes from octave to octave.
inline Model mountains(int width, int height, double cell, double relief, double rough = 0.5) {
  Model m(width, height, cell, cell);
  double amplitude = relief;
  for (int octave = 0, period = 64; period >= 1; period /= 2, ++octave, amplitude *= rough) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double fx = double(x) / period, fy = double(y) / period;
        const int i = int(fx), j = int(fy);
        auto smooth = [](double t) { return t * t * (3 - 2 * t); };
        const double u = smooth(fx - i), v = smooth(fy - j);
        auto n = [&](int a, int b) { return hash01(i + a, j + b, octave + 1); };
        m(x, y) += float(amplitude * ((1 - v) * ((1 - u) * n(0, 0) + u * n(1, 0)) +
                                      v * ((1 - u) * n(0, 1) + u * n(1, 1))));
      }
    }
  }
  return m;
}

// Flat ground with boxes of 5 to 25 metres along streets of 14 and 16 metres; cells of a metre.
inline Model city(int width, int height) {
  Model m(width, height, 1, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool street = x % 40 < 14 || y % 48 < 16;
      m(x, y) = street ? 0 : float(5 + 20 * hash01(x / 40, y / 48, 7));
    }
  }
  return m;
}

// The tangent of the horizon's angle from a cell, marched at half cells from `start` cells on to
// the border or `radius`. Lowest: nothing there.
inline double marched_slope(const Model& m, int x, int y, double azimuth, double radius,
                            double step = 0.5,
                            double earth = std::numeric_limits<double>::infinity()) {
  const double across = std::sin(azimuth) / m.cell_width, down = -std::cos(azimuth) / m.cell_height;
  const double cell = 1 / std::max(std::fabs(across), std::fabs(down));  // world units a row
  double best = std::numeric_limits<double>::lowest();
  for (double n = step;; n += step) {
    const double s = n * cell, px = x + across * s, py = y + down * s;
    if (px < -1e-9 || py < -1e-9 || px > m.width - 1 + 1e-9 || py > m.height - 1 + 1e-9) break;
    if (s > radius * (1 + 1e-9)) break;
    best = std::max(best, (m.at(px, py) - m(x, y)) / s - s / (2 * earth));
  }
  return best;
}

struct Seen {
  double svf = 0, svf_normal = 0, svf_cosine = 0, openness = 0, visible_sky = 0;
};

// From angles, by the definitions.
inline Seen marched(const Model& m, int x, int y, int azimuths,
                    double radius = std::numeric_limits<double>::infinity()) {
  const double pi = std::numbers::pi;
  auto slope = [&](int x0, int y0, int x1, int y1, double cell) {
    x0 = std::max(x0, 0), y0 = std::max(y0, 0);
    x1 = std::min(x1, m.width - 1), y1 = std::min(y1, m.height - 1);
    const int cells = x1 - x0 + y1 - y0;
    return cells > 0 ? (m(x1, y1) - m(x0, y0)) / (cells * cell) : 0.0;
  };
  const double east = slope(x - 1, y, x + 1, y, m.cell_width);
  const double north = -slope(x, y - 1, x, y + 1, m.cell_height);
  const double b = std::atan(std::hypot(east, north)), a = std::atan2(-east, -north);
  Seen seen;
  for (int k = 0; k < azimuths; ++k) {
    const double phi = 2 * pi * k / azimuths;
    const double t = marched_slope(m, x, y, phi, radius);
    const double gamma = t < -1e30 ? 0 : std::atan(t), above = std::max(gamma, 0.0);
    const double tangent = std::atan(-std::tan(b) * std::cos(phi - a));
    const double g = std::max(above, tangent);
    seen.svf += 1 - std::sin(above);
    seen.svf_normal += std::cos(b) * std::cos(g) * std::cos(g) +
                       std::sin(b) * std::cos(phi - a) * (pi / 2 - g - std::sin(g) * std::cos(g));
    seen.svf_cosine += std::cos(above) * std::cos(above);
    seen.openness += 90 - gamma * 180 / pi;
    seen.visible_sky += 100 * (1 - above / (pi / 2));
  }
  for (double* v :
       {&seen.svf, &seen.svf_normal, &seen.svf_cosine, &seen.openness, &seen.visible_sky}) {
    *v /= azimuths;
  }
  return seen;
}

}  // namespace obscura::reference

#endif  // OBSCURA_TESTS_REFERENCE_TERRAIN_H_
