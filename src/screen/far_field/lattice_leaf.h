// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after view/taps_leaf.h and
// math/apart_leaf.h. No include guard, for it is included once per SIMD target. What passes know of
// the depth image (plane.h).

const float kSmallest = 1e-30f;

// Rows less than this apart are next to each other.
const float kNextRow = 1.5f;

// What is interpolated between texels: 1/depth, or for parallel rays depth itself; 0 on the
// background.
LEAF(Real) lattice_of_depth(Real depth, bool parallel) {
  Real value = parallel ? depth : real(1.0f) / depth;
  return leaf_where(leaf_less(depth, leaf_inf()), value);
}
LEAF(Real) depth_of_lattice(Real g, bool parallel) { return parallel ? g : real(1.0f) / g; }
// The same to the last bits but one.
LEAF(Real) near_depth_of_lattice(Real g, bool parallel) {
  return parallel ? g : leaf_reciprocal(g);
}

// Between texel values a and b.
LEAF(Real) blended(Real a, Real b, Real blend) { return leaf_fma(blend, b - a, a); }

// A texel beside others whose nearest depth is `nearest`, for blending: what lies apart is
// background there. In perspective that is 0, infinitely far; where rays are parallel, a texel of
// just that much more depth.
LEAF(Real) nearest_of_lattice(Real a, Real b, bool parallel) {
  Real least = leaf_min(a, b), most = leaf_max(a, b);
  return parallel ? leaf_select(leaf_less(real(0.0f), least), least, most) : most;
}
LEAF(Real) texel_beside(Real nearest, Real g, bool parallel) {
  if (parallel) {
    Truth beside = leaf_both(leaf_less(real(0.0f), g), lies_beside(nearest, g));
    return leaf_select(beside, g, real(kApart) * nearest);
  }
  return leaf_where(lies_beside(g, nearest), g);
}

// Whether two pieces of matter, from `front` to `back`, touch: `slack` is a share of the nearer.
LEAF(Truth) matter_touches(Real front_a, Real back_a, Real front_b, Real back_b, Real slack) {
  Real nearer = leaf_min(front_a, front_b), farther = leaf_max(front_a, front_b);
  Real gap = farther - leaf_min(back_a, back_b);
  return leaf_both(leaf_less_equal(gap, slack * nearer), lies_beside(nearer, farther));
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
             bool parallel) {
  Real tiny = real(kSmallest);
  Truth touches =
      leaf_both(leaf_less(real(0.0f), leaf_min(a, b)),
                matter_touches(near_depth_of_lattice(leaf_max(a, tiny), parallel), back_a,
                               near_depth_of_lattice(leaf_max(b, tiny), parallel), back_b, slack));
  Real g = leaf_select(touches, blended(a, b, blend), leaf_select(first, a, b));
  Crossing c;
  c.surface = leaf_less(real(0.0f), g);
  c.depth = near_depth_of_lattice(leaf_max(g, tiny), parallel);
  c.back = leaf_max(leaf_select(first, back_a, back_b), c.depth);
  return c;
}
