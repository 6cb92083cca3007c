#ifndef OBSCURA_SRC_MATH_SPHERE_LINE_H_
#define OBSCURA_SRC_MATH_SPHERE_LINE_H_

#include <algorithm>
#include <cmath>

#include "math/leaf_cpp.h"

// The words of math/sphere_line_leaf.h in double, for tables.
namespace obscura::leaf_double {

using Real = double;

LEAF(Real) real(double x) { return x; }
LEAF(Real) leaf_abs(Real x) { return std::abs(x); }
LEAF(Real) leaf_sqrt(Real x) { return std::sqrt(x); }
LEAF(Real) leaf_log(Real x) { return std::log(x); }
LEAF(Real) leaf_fma(Real a, Real b, Real c) { return a * b + c; }
LEAF(Real) leaf_copysign(Real magnitude, Real z) { return std::copysign(magnitude, z); }
#include "math/sphere_line_leaf.h"

}  // namespace obscura::leaf_double

namespace obscura::math {

// As the leaf function, for any lateral >= 0.
inline double quadratic_line_integral(double z, double lateral) {
  return leaf_double::quadratic_line(z, std::max(lateral, 1e-12));
}

}  // namespace obscura::math

#endif  // OBSCURA_SRC_MATH_SPHERE_LINE_H_
