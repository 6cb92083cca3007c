// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after view/receiver_leaf.h. No include guard,
// for it is included once per SIMD target.

// Whether a surface at depth offset `at` lies in front of a sample: with normals the bracket is the
// difference of their heights above the tangent plane, otherwise `level` is the sample's depth
// offset, negated.
LEAF(Truth) in_front_by_plane(Real at, Real slope, Real level) {
  return leaf_less(leaf_fms(at, slope, level) * slope, real(0.0f));
}
LEAF(Truth) in_front_by_depth(Real at, Real level) { return leaf_less(at, leaf_neg(level)); }

// The sample's level, `height` radii above the tangent plane.
LEAF(Real) level_above_plane(LEAF_IN(TapReceiver) r, Real height, Real radius, Real q) {
  return leaf_fma(height, radius, leaf_fma(r.distance, q, real(kDepthGrain) * r.z));
}
