// Leaf function, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target.

// Integral of rho(r) = (1 - r)^2 along a line of the unit sphere from its middle to z, where the
// line passes the centre at distance l = lateral >= 1e-6:
//   z (1 + l^2) + z^3/3 - z sqrt(l^2 + z^2) - l^2 asinh(z/l).
// asinh by the logarithm of |z|, for the integral is odd.
LEAF(Real) quadratic_line(Real z, Real lateral) {
  Real square = lateral * lateral;
  Real a = leaf_abs(z);
  Real s = leaf_sqrt(leaf_fma(a, a, square));
  Real arc = leaf_log((a + s) / lateral);
  Real polynomial = leaf_fma(a * a, real(1.0f) / real(3.0f), real(1.0f) + square - s);
  return leaf_copysign(a * polynomial - square * arc, z);
}
