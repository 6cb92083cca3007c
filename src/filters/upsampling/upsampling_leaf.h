// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after filters/edge_leaf.h. No include guard,
// for it is included once per SIMD target.

// A neighbour whose normal is at right angles counts this much of one whose normal is the same.
const float kLeastAlike = 1e-3f;
LEAF(Real) likeness(Real cosine) {
  Real square = cosine * cosine;
  return leaf_fma(square, square, real(kLeastAlike));
}

// What the neighbours before and after a pixel weigh.
struct SideWeights {
  Real before, after;
};
// By their surfaces (filters/edge_leaf.h) and the pixel's own, s. The nearer one goes on by its own
// slope; how far from it the other lies is what both slopes differ by.
LEAF(SideWeights)
side_weights(Real s, Real before, Real after, Truth has_before, Truth has_after, Real edge,
             bool parallel) {
  Real one = real(1.0f);
  Real down = s - before, up = after - s;
  Truth nearer_after = leaf_both(
      has_after, leaf_either(leaf_not(has_before), leaf_less(leaf_abs(up), leaf_abs(down))));
  Real scale = parallel ? one : leaf_max(s, real(1e-30f));
  Real gap = (up - down) / (scale * edge);
  Real other = leaf_where(leaf_both(has_before, has_after), edge_weight(gap));
  SideWeights w;
  w.before = leaf_select(nearer_after, other, one);
  w.after = leaf_select(nearer_after, one, other);
  return w;
}
