// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target. What edge-aware blurs ask of surfaces: 1/depth, or depth in a parallel view, which
// are linear on planes.

// Change of the receiver's surface per pixel: of the differences to the pixels after and before the
// smaller, infinite where there is background; 0 if both are.
LEAF(Real) surface_slope(Real after, Real before) {
  Real slope = leaf_if_less(leaf_abs(before), leaf_abs(after), before, after);
  return leaf_if_less(leaf_abs(slope), real(3.4e38f), slope, real(0.0f));
}

// (1 - gap^2)^2 for a gap to the continued surface, in edges, and 0 beyond 1, or if it is no
// number.
LEAF(Real) edge_weight(Real gap) {
  Real near = leaf_nfma(gap, gap, real(1.0f));
  return leaf_if_less(real(0.0f), near, near * near, real(0.0f));
}
