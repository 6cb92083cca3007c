#include "io/images/rotation_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura::tools {
namespace {

double determinant(const double m[3][3]) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

}  // namespace

std::optional<RotationFit> fit_rotation(const double m[3][3]) {
  // The orthogonal factor of the polar decomposition, by Newton's iteration X <- (X + X^-T) / 2
  // (Higham 1986). The determinant of m shows whether the vectors span space.
  const double d = determinant(m);
  if (!(std::abs(d) > 1e-6)) return std::nullopt;
  double x[3][3];
  std::copy_n(&m[0][0], 9, &x[0][0]);
  for (int step = 0; step < 60; ++step) {
    const double det = determinant(x);
    double next[3][3], change = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
        const double cofactor = x[a][c] * x[b][e] - x[a][e] * x[b][c];
        next[i][j] = 0.5 * (x[i][j] + cofactor / det);
        change = std::max(change, std::abs(next[i][j] - x[i][j]));
      }
    }
    std::copy_n(&next[0][0], 9, &x[0][0]);
    if (change < 1e-14) break;
  }
  RotationFit fit;
  std::copy_n(&x[0][0], 9, &fit.matrix[0][0]);
  fit.mirrored = d < 0;
  const double trace = x[0][0] + x[1][1] + (fit.mirrored ? -x[2][2] : x[2][2]);
  fit.degrees = std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / std::numbers::pi;
  return fit;
}

}  // namespace obscura::tools
