// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after view/taps_leaf.h. No include guard, for
// it is included once per SIMD target. Directions over the hemisphere, each tested at a few points.

struct EyeDirection {
  Real x, y, z;
};
LEAF(EyeDirection) vector_of(Real x, Real y, Real z) {
  EyeDirection v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
LEAF(Real) dot_of(LEAF_IN(EyeDirection) a, LEAF_IN(EyeDirection) b) {
  return leaf_fma(a.x, b.x, leaf_fma(a.y, b.y, a.z * b.z));
}

// A receiver and the two tangents that complete its normal (Duff et al. 2017).
struct HemisphereReceiver {
  Real x, y, z;  // eye space; z is depth
  EyeDirection n, t, b;
  Real plane;  // n.p
  Real slack;  // heights above the tangent plane that are rounding
};
// Of the pixel whose ray is (ray_x, ray_y, -1), or that starts there where rays are parallel.
LEAF(HemisphereReceiver)
hemisphere_receiver(Real ray_x, Real ray_y, Real z, LEAF_IN(EyeDirection) n, bool parallel) {
  Real one = real(1.0f);
  HemisphereReceiver r;
  Real away = parallel ? one : z;
  r.x = ray_x * away;
  r.y = ray_y * away;
  r.z = z;
  r.n = n;
  Real side = leaf_copysign(one, n.z);
  Real k = real(-1.0f) / (side + n.z);
  Real xy = (n.x * n.y) * k;
  r.t = vector_of(leaf_fma(side * n.x, n.x * k, one), side * xy, leaf_neg(side * n.x));
  r.b = vector_of(xy, leaf_fma(n.y * n.y, k, side), leaf_neg(n.y));
  r.plane = dot_of(n, vector_of(r.x, r.y, leaf_neg(z)));
  r.slack = z * real(1e-5f);
  return r;
}

// Where in the image the point at distance t along w is seen.
struct Seen {
  Real z, u, v;
};
LEAF(Seen)
image_of_point(LEAF_IN(HemisphereReceiver) r, LEAF_IN(EyeDirection) w, Real t, Real per_scale_x,
               Real per_scale_y, Real center_u, Real center_v, bool parallel) {
  Seen s;
  s.z = leaf_nfma(t, w.z, r.z);
  Real x = leaf_fma(t, w.x, r.x), y = leaf_fma(t, w.y, r.y);
  Real away = parallel ? real(1.0f) : real(1.0f) / s.z;
  s.u = leaf_fma(x * away, per_scale_x, center_u);
  s.v = leaf_nfma(y * away, per_scale_y, center_v);
  return s;
}

// Whether the point at distance t along w, at depth z, lies behind the texel whose ray is (a, b,
// -1) and whose depth is `depth`. The point is moved to that ray, parallel to the tangent plane, so
// that a plane of any tilt never occludes itself: with q the surface point on that ray, it is
// behind if n.(q - p) > t n.w. The texel's matter, if it is `finite`, ends at depth `back`.
LEAF(Truth)
is_behind(LEAF_IN(HemisphereReceiver) r, Real cosine, Real t, Real z, Real a, Real b, Real depth,
          bool parallel, bool finite, Real back) {
  Real across = leaf_fma(r.n.x, a, r.n.y * b);
  // n.q, and how the height above the plane grows with depth along the texel's ray.
  Real slope = parallel ? leaf_neg(r.n.z) : across - r.n.z;
  Real q = parallel ? leaf_nfma(r.n.z, depth, across) : depth * slope;
  Real height = leaf_fma(t, cosine, r.plane + r.slack);
  // A ray that runs away from the plane bounds nothing: there depths decide.
  Truth bounded = leaf_less(slope, real(0.0f));
  Truth behind = leaf_either(leaf_both(bounded, leaf_less(height, q)),
                             leaf_both(leaf_not(bounded), leaf_less(depth, z)));
  if (finite) behind = leaf_both(behind, leaf_less(z, back));
  return behind;
}

// The sine that goes with a direction's cosine; strata of equal solid angle in height.
LEAF(Real) stratum_cosine(Real sample_index, Real shift, Real stratum) {
  return leaf_nfma(sample_index + shift, stratum, real(1.0f));
}
LEAF(Real) sine_of(Real cosine) {
  return leaf_sqrt(leaf_max(leaf_nfma(cosine, cosine, real(1.0f)), real(0.0f)));
}
// The direction (lx, ly, cosine) of the receiver's frame in eye space.
LEAF(EyeDirection) in_eye_space(LEAF_IN(HemisphereReceiver) r, Real lx, Real ly, Real cosine) {
  return vector_of(leaf_fma(lx, r.t.x, leaf_fma(ly, r.b.x, cosine * r.n.x)),
                   leaf_fma(lx, r.t.y, leaf_fma(ly, r.b.y, cosine * r.n.y)),
                   leaf_fma(lx, r.t.z, leaf_fma(ly, r.b.z, cosine * r.n.z)));
}
// Distance of test k: denser towards the receiver, where occluders cover more of the hemisphere.
LEAF(Real) test_distance(Real test_index, Real offset, Real per_test, Real radius) {
  Real share = (test_index + offset) * per_test;
  return (share * share) * radius;
}
// V = 1 - rho at the first point that is behind.
LEAF(Real) visible_beyond(Real t, Real inverse_radius, bool quadratic) {
  Real near = leaf_nfma(t, inverse_radius, real(1.0f));
  return quadratic ? leaf_nfma(near, near, real(1.0f)) : real(0.0f);
}
