// Leaf function, C++ and GLSL: see math/leaf-inl.h; after math/falloff_kinds_leaf.h, in C++ within
// a class. Before this: kFalloff, the numbers of math::Rho (rho_radius(), rho_inverse_radius(),
// rho_entries_per_length(), rho_last_entry()), entry i of its table (rho_entry(i)), the same
// blended with the next one (rho_between(i, t)), and rho_exp_negative(t), exp(-t) as exact as is
// needed.

// From which depth on a surface has no effect on a receiver at depth z, as a backdrop: more than
// eight times as far behind it as the camera is in front, and as the falloff reaches. At eight
// radii the exponential is 3e-4; the inverse square takes 64 for that. A function may reach
// anywhere.
LEAF(Real) depth_without_effect(Real z) {
  if (kFalloff == kFunctionRho) return leaf_inf();
  float radii = kFalloff == kInverseSquareRho ? 64.0f : 8.0f;
  return z + leaf_max(real(8.0f) * z, real(radii) * rho_radius());
}

// rho of a distance in [0, FLT_MAX].
LEAF(Real) rho_of(Real x) {
  Real t = x * rho_inverse_radius();
  if (kFalloff == kConstantRho) {
    return leaf_where(leaf_less_equal(x, rho_radius()), real(1.0f));
  }
  if (kFalloff == kExponentialRho) return rho_exp_negative(t);
  if (kFalloff == kQuadraticRho) {
    Real rest = leaf_max(real(0.0f), leaf_nfma(x, rho_inverse_radius(), real(1.0f)));
    return rest * rest;
  }
  if (kFalloff == kInverseSquareRho) return real(1.0f) / leaf_fma(t, t, real(1.0f));
  if (kFalloff == kTableRho) {
    Real at = leaf_min(x * rho_entries_per_length(), rho_last_entry());
    Int entry = leaf_int(at);
    Real value = rho_between(entry, at - leaf_from_int(entry));
    return leaf_where(leaf_less_equal(x, rho_radius()), value);
  }
  // A float's upper bits count knots, the rest is the place between two of them. Nearer than the
  // first it is linear from rho(0), farther than the last constant.
  Int bits = leaf_bits_of(leaf_min(leaf_max(x, real(kFirstKnot)), real(kLastKnot)));
  Int knot =
      leaf_shift_right(bits, kFractionBits) - leaf_whole(((kFirstOctave + 127) << kKnotBits) - 1);
  Real between = leaf_from_int(leaf_and(bits, leaf_whole((1 << kFractionBits) - 1))) *
                 real(1.0f / float(1 << kFractionBits));
  Real value = rho_between(knot, between);
  Real near = leaf_fma(x * real(kPerFirstKnot), rho_entry(1) - rho_entry(0), rho_entry(0));
  return leaf_select(leaf_less(x, real(kFirstKnot)), near, value);
}
