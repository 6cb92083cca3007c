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

// How many edges lie in a unit of the surface's values: differences of 1/depth are differences of
// depth times -1/depth^2.
LEAF(Real) edges_per_unit(Real surface, Real inverse_edge, bool parallel) {
  return parallel ? inverse_edge : inverse_edge / (surface * surface);
}

// 1/edge, where an edge is no longer than a share of the pixel's own depth: `per_depth` is 1/share,
// or 0. Surfaces are positive.
LEAF(Real) inverse_of_edge(Real inverse_edge, Real surface, Real per_depth, bool parallel) {
  Real near = parallel ? per_depth / surface : per_depth * surface;
  return leaf_max(inverse_edge, near);
}

// From the surface of tap k to the continuation of the receiver's, in edges.
LEAF(Real) gap_to_surface(Real tap, Real surface, Real slope, Real k, Real per_unit) {
  return (tap - leaf_fma(slope, k, surface)) * per_unit;
}

// Binomial weights of the bilateral blur's 9 taps, by distance.
const float kBinomial[5] = LEAF_LIST(70.0f, 56.0f, 28.0f, 8.0f, 1.0f);

// What a tap of the interleaved blur weighs, by its gap and by how alike the normals are.
LEAF(Real) weight_of_tap(Real gap, Real alike) {
  Real sharp = alike * alike;
  return leaf_where(leaf_less(real(0.0f), alike), edge_weight(gap) * (sharp * sharp));
}
