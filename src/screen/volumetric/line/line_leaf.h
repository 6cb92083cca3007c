// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target. Lengths are in the lines' unit.

const float kMaxThickness = 1e30f;

// Where the tangent plane bounds a line of half-length zs around the sphere's centre, which lies
// `nearer` than the receiver: the plane's depth on the texel's ray is z + scaled_q / slope, unless
// the ray does not hit it in front of the camera (slope >= 0); then it bounds nothing.
LEAF(Real) plane_bound(Real scaled_q, Real slope, Real nearer, Real zs) {
  Real bounded = leaf_max(leaf_min(scaled_q / slope + nearer, zs), leaf_neg(zs));
  return leaf_if_negative(slope, bounded, zs);
}
