#ifndef OBSCURA_SRC_MATH_LEAF_SCALAR_H_
#define OBSCURA_SRC_MATH_LEAF_SCALAR_H_

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/leaf_cpp.h"

// The words of leaf files over plain floats; math/leaf-inl.h says what a leaf file is.
namespace obscura::leaf_scalar {

using Real = float;
using Truth = bool;
using Int = std::int32_t;

LEAF(Real) real(float x) { return x; }
LEAF(Real) leaf_inf() { return std::numeric_limits<float>::infinity(); }
LEAF(Real) leaf_neg(Real x) { return -x; }
LEAF(Real) leaf_abs(Real x) { return std::abs(x); }
LEAF(Real) leaf_sqrt(Real x) { return std::sqrt(x); }
LEAF(Real) leaf_inverse_sqrt(Real x) { return 1 / std::sqrt(x); }
LEAF(Real) leaf_reciprocal(Real x) { return 1 / x; }
LEAF(Real) leaf_fma(Real a, Real b, Real c) { return a * b + c; }
LEAF(Real) leaf_nfma(Real a, Real b, Real c) { return c - a * b; }
LEAF(Real) leaf_fms(Real a, Real b, Real c) { return a * b - c; }
LEAF(Real) leaf_min(Real a, Real b) { return a < b ? a : b; }
LEAF(Real) leaf_max(Real a, Real b) { return a > b ? a : b; }
LEAF(Real) leaf_if_negative(Real x, Real yes, Real no) { return x < 0 ? yes : no; }
LEAF(Truth) leaf_less(Real a, Real b) { return a < b; }
LEAF(Truth) leaf_less_equal(Real a, Real b) { return a <= b; }
LEAF(Truth) leaf_both(Truth a, Truth b) { return a && b; }
LEAF(Real) leaf_select(Truth t, Real yes, Real no) { return t ? yes : no; }
LEAF(Real) leaf_where(Truth t, Real yes) { return t ? yes : 0.0f; }

LEAF(Int) leaf_whole(int i) { return i; }
LEAF(Int) leaf_int(Real x) { return static_cast<Int>(x); }
LEAF(Real) leaf_from_int(Int i) { return static_cast<float>(i); }
LEAF(Int) leaf_bits_of(Real x) { return std::bit_cast<Int>(x); }
LEAF(Int) leaf_shift_right(Int i, int bits) { return i >> bits; }
LEAF(Int) leaf_and(Int a, Int b) { return a & b; }

#include "math/slab_leaf.h"
// After slab_leaf.h.
#include "math/azimuth_leaf.h"
#include "math/cone_leaf.h"

}  // namespace obscura::leaf_scalar

#endif  // OBSCURA_SRC_MATH_LEAF_SCALAR_H_
