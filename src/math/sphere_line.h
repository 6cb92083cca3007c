#ifndef OBSCURA_SRC_MATH_SPHERE_LINE_H_
#define OBSCURA_SRC_MATH_SPHERE_LINE_H_

#include <algorithm>
#include <cmath>

namespace obscura::math {

// Integral of rho(r) = (1 - r)^2 along a line of the unit sphere from its middle to z, where the
// line passes the centre at distance `lateral`:
//   z (1 + l^2) + z^3/3 - z sqrt(l^2 + z^2) - l^2 asinh(z/l), an odd function of z.
inline double quadratic_line(double z, double lateral) {
  const double l = std::max(lateral, 1e-12), square = l * l;
  return z * (1 + square) + z * z * z / 3 - z * std::sqrt(square + z * z) -
         square * std::asinh(z / l);
}

}  // namespace obscura::math

#endif  // OBSCURA_SRC_MATH_SPHERE_LINE_H_
