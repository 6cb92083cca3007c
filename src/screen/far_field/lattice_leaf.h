// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after view/taps_leaf.h. No include guard, for
// it is included once per SIMD target. What passes know of the depth image (plane.h).

const float kSmallest = 1e-30f;

// Rows less than this apart are next to each other.
const float kNextRow = 1.5f;

// What is interpolated between texels: 1/depth, or for parallel rays ortho_offset - depth; 0 on the
// background.
LEAF(Real) lattice_of_depth(Real depth, Real ortho_offset, bool parallel) {
  Real value = parallel ? ortho_offset - depth : real(1.0f) / depth;
  return leaf_where(leaf_less(depth, leaf_inf()), value);
}
LEAF(Real) depth_of_lattice(Real g, Real ortho_offset, bool parallel) {
  return parallel ? ortho_offset - g : real(1.0f) / g;
}
// The same to the last bits but one.
LEAF(Real) near_depth_of_lattice(Real g, Real ortho_offset, bool parallel) {
  return parallel ? ortho_offset - g : leaf_reciprocal(g);
}

// Between texel values a and b.
LEAF(Real) blended(Real a, Real b, Real blend) { return leaf_fma(blend, b - a, a); }

// Whether two pieces of matter, from `front` to `back`, touch: `slack` is a share of the nearer.
LEAF(Truth) matter_touches(Real front_a, Real back_a, Real front_b, Real back_b, Real slack) {
  Real gap = leaf_max(front_a, front_b) - leaf_min(back_a, back_b);
  return leaf_less_equal(gap, slack * leaf_min(front_a, front_b));
}

// The two receiver lines meet where z = m0 and slope x = m1 - m0: the outward coordinate there.
LEAF(Real) outward_of(Real slope, Real nearest, Real slanted) {
  return slope * (slanted + nearest);
}

// What a line that crosses a row between two texels, `blend` on the way from the first to the
// second, meets of finite matter: blended where the texels' matter touches, else the nearer texel.
struct Crossing {
  Real depth, back;
  Truth surface;
};
LEAF(Crossing)
cross_matter(Real a, Real b, Real back_a, Real back_b, Real blend, Truth first, Real slack,
             Real ortho_offset, bool parallel) {
  Real tiny = real(kSmallest);
  Truth touches = leaf_both(
      leaf_less(real(0.0f), leaf_min(a, b)),
      matter_touches(near_depth_of_lattice(leaf_max(a, tiny), ortho_offset, parallel), back_a,
                     near_depth_of_lattice(leaf_max(b, tiny), ortho_offset, parallel), back_b,
                     slack));
  Real g = leaf_select(touches, blended(a, b, blend), leaf_select(first, a, b));
  Crossing c;
  c.surface = leaf_less(real(0.0f), g);
  c.depth = near_depth_of_lattice(leaf_max(g, tiny), ortho_offset, parallel);
  c.back = leaf_max(leaf_select(first, back_a, back_b), c.depth);
  return c;
}
