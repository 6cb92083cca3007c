// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/sphere_line_leaf.h. No include
// guard, for it is included once per SIMD target. Lengths are in radii.

// Deviations below this count as this: it keeps quotients finite.
const float kLeastDeviation = 1e-3f;
const float kMaxOffset = 1e30f;
// Which part of the way to the tangent plane's horizon a kernel may cover.
const float kHorizonShare = 0.5f;

// Integral of rho(z) (end - z) from lo to hi, rho = 1.
LEAF(Real) constant_ramp(Real lo, Real hi, Real end) {
  return (hi - lo) * leaf_nfma(real(0.5f), lo + hi, end);
}

// The integral of z (1 - s)^2 is s^2/2 - 2 s^3/3 + s^4/4 with s^2 = l^2 + z^2.
LEAF(Real) quadratic_moment(Real z, Real lateral) {
  Real square = leaf_fma(z, z, lateral * lateral);
  Real s = leaf_sqrt(square);
  return square * leaf_fma(square, real(0.25f), leaf_nfma(s, real(2.0f / 3), real(0.5f)));
}

// The same with rho = (1 - s)^2, whose integrals up to lo and hi are rho_lo and rho_hi.
LEAF(Real) quadratic_ramp(Real lo, Real hi, Real end, Real rho_lo, Real rho_hi, Real lateral) {
  Real first = quadratic_moment(hi, lateral) - quadratic_moment(lo, lateral);
  return end * (rho_hi - rho_lo) - first;
}

// What a pyramid would say of the tangent plane: mean depth offset and deviation.
struct PlaneMoments {
  Real mean;
  Real deviation;
};

// Under a kernel whose deviation lies between width0 and width1 pixels, by `blend`. `gradient` is
// how much n.r' changes per pixel along its steepest direction; `distance` is the depth z, or 1
// where rays are parallel (perspective 0).
LEAF(PlaneMoments)
plane_moments(Real q, Real slope, Real gradient, Real distance, Real perspective, Real width0,
              Real width1, Real blend, Real per_radius) {
  Real width = leaf_fma(blend, width1 - width0, width0);
  Real variance = leaf_fma(blend * (width1 - width0), width1 + width0, width0 * width0);
  // In perspective the plane's depth is z facing / slope, and bends: its mean lies deeper by the
  // square of its relative deviation.
  Real per_slope = leaf_reciprocal(slope);
  Real offset = distance * q * per_slope;
  Real per_pixel = gradient * leaf_abs(per_slope);
  Real depth = leaf_fma(perspective, offset, distance);
  Real bend = perspective * (per_pixel * per_pixel) * depth;
  // A plane that a ray does not hit in front of the camera bounds nothing.
  Real far = real(kMaxOffset);
  Real middle = leaf_min(leaf_fma(bend, variance, offset) * per_radius, far);
  Real slant = leaf_min(per_pixel * width * depth * per_radius, far);
  PlaneMoments moments;
  moments.mean = leaf_if_negative(slope, middle, far);
  moments.deviation = leaf_if_negative(slope, slant, real(0.0f));
  return moments;
}

// Times a texel's slope: how many pixels its kernel may reach towards the tangent plane's horizon,
// the line where rays are parallel to the plane. Towards it depth bends, and beyond is no plane.
LEAF(Real) horizon_per_slope(Real gradient, Real perspective) {
  return real(-kHorizonShare) / leaf_max(gradient * perspective, real(1e-30f));
}

// Which level of the pyramid a sample sees, less 1/2, so that the integer to round to is the one
// below: `reach` is the level of the sphere's radius in pixels, `sample_level` the sample's from
// there. `room` pixels from the image's border, or where a kernel may reach `horizon` pixels only,
// the level sinks until the next one's kernel, 4 2^l - 2 pixels to each side, fits in: to
// log2(room + 2) - 2, linear between powers of two and so never too large, which is how a float's
// bits lie.
LEAF(Real) level_of_sample(Real reach, Real sample_level, Real room, Real horizon, Real last) {
  Real span = leaf_max(leaf_min(room, horizon), real(0.0f)) + real(2.0f);
  Real bits = leaf_from_int(leaf_bits_of(span));
  Real fits = leaf_fma(bits, real(1.0f / 8388608.0f), real(-129.5f));
  return leaf_max(leaf_min(reach + sample_level, leaf_min(fits, last)), real(-0.5f));
}

// The mean depth offset and the deviation in radii, kept finite.
LEAF(Real) bounded_mean(Real mean) {
  return leaf_max(leaf_min(mean, real(kMaxOffset)), real(-kMaxOffset));
}
LEAF(Real) bounded_deviation(Real deviation) {
  return leaf_max(leaf_min(deviation, real(kMaxOffset)), real(kLeastDeviation));
}

// What is open of a sample's line, and what the tangent plane leaves of it.
struct SampleLine {
  Real open, bound;
};
