// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target.

// acos(x) for |x| <= 1, absolute error under 1e-6: sqrt(1 - |x|) times the polynomial of Abramowitz
// and Stegun 4.4.46, mirrored for x < 0.
LEAF(Real) fast_acos(Real x) {
  Real a = leaf_min(leaf_abs(x), real(1.0f));
  Real p = real(-0.0012624911f);
  p = leaf_fma(p, a, real(0.0066700901f));
  p = leaf_fma(p, a, real(-0.0170881256f));
  p = leaf_fma(p, a, real(0.0308918810f));
  p = leaf_fma(p, a, real(-0.0501743046f));
  p = leaf_fma(p, a, real(0.0889789874f));
  p = leaf_fma(p, a, real(-0.2145988016f));
  p = leaf_fma(p, a, real(1.5707963050f));
  Real rest = real(1.0f) - a;
  Real r = p * (rest * leaf_inverse_sqrt(leaf_max(rest, real(1e-30f))));
  return leaf_if_negative(x, real(3.14159265f) - r, r);
}

// Antiderivatives at theta, times sin theta, the width of a slice, in the frame of
// math/slice_leaf.h.

// F(theta), the integral of (nz cos t + nt sin t) sin t from 0 to theta: what rho = 1 obscures.
LEAF(Real) cosine_integral(Real nz, Real nt, Real sine, Real cosine, Real angle) {
  return real(0.5f) * (nz * (sine * sine) + nt * leaf_nfma(sine, cosine, angle));
}

// Of the direction (sin t, cos t): along the tangent, along the zenith.
LEAF(Real) uniform_along(Real sine, Real cosine, Real angle) {
  return real(0.5f) * leaf_nfma(sine, cosine, angle);
}
LEAF(Real) uniform_zenith(Real sine) { return real(0.5f) * (sine * sine); }

// The same, weighted by (nz cos t + nt sin t).
LEAF(Real) weighted_along(Real nz, Real nt, Real sine, Real cosine) {
  Real s3 = real(1.0f / 3.0f) * (sine * (sine * sine));
  Real c3 = real(1.0f / 3.0f) * (cosine * (cosine * cosine));
  return leaf_fma(nz, s3, nt * (c3 - cosine));
}
LEAF(Real) weighted_zenith(Real nz, Real nt, Real sine, Real cosine) {
  Real s3 = real(1.0f / 3.0f) * (sine * (sine * sine));
  Real c3 = real(1.0f / 3.0f) * (cosine * (cosine * cosine));
  return nt * s3 - nz * c3;
}
