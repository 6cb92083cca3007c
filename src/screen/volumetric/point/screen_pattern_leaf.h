// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after view/receiver_leaf.h. No include guard,
// for it is included once per SIMD target.

// From the receiver to a surface point, P' - P = t r' - z r, and how it occludes.
struct ScreenPoint {
  Real x, y, z;
  Real inverse;  // 1 / its length
  Real share;    // rho times the sample's weight; 0 where it does not occlude
};
// Of the texel (kx, ky) pixels away at depth offset `offset`, finite. `by_plane`: heights count
// from the tangent plane. What lies no higher above it than `grain` times its distance lies on it.
LEAF(ScreenPoint)
screen_point(LEAF_IN(TapReceiver) r, Real kx, Real ky, Real offset, Real per_radius, Real grain,
             Real weight, bool quadratic, bool by_plane) {
  ScreenPoint p;
  p.x = leaf_fma(offset, texel_ray_a(r, kx), r.distance * (kx * r.scale_x));
  p.y = leaf_fms(offset, texel_ray_b(r, ky), r.distance * (ky * r.scale_y));
  p.z = leaf_neg(offset);
  Real square = leaf_fma(p.x, p.x, leaf_fma(p.y, p.y, offset * offset));
  square = leaf_max(square, real(1e-37f));
  p.inverse = leaf_inverse_sqrt(square);
  Real length_of = (square * p.inverse) * per_radius, height = p.z;
  if (by_plane) {
    TexelPlane plane = plane_at(r, kx, ky);
    height = leaf_fms(offset, plane.slope, r.distance * plane.q);
  }
  Real near = real(1.0f) - length_of;
  Real rho = quadratic ? near * near : real(1.0f);
  Real bias = leaf_fma(grain, length_of, real(kDepthGrain) * r.z);
  Truth occludes = leaf_both(leaf_less_equal(real(0.0f), near), leaf_less(bias, height));
  p.share = leaf_where(occludes, rho * weight);
  return p;
}
