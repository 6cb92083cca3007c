// Leaf functions, C++ and GLSL: see math/leaf-inl.h. How wide the piece of surface is that a texel
// belongs to (view/widths.h). A run counts texels, along a row or a column.

// Neighbours belong to one piece as long as their depths differ by no more than a surface's do that
// is seen at a grazing angle, in footprints of a pixel; in between they belong together in part, so
// that nothing jumps as depths change.
const float kJoinedSteps = 6.0f, kPartedSteps = 10.0f;

// To what part neighbours at depths a and b belong to one piece; 0 beside the background.
LEAF(Real) joined_part(Real a, Real b, Real scale, bool parallel) {
  Real footprint = parallel ? scale : scale * leaf_min(a, b);
  Real steps = leaf_abs(a - b) / footprint;
  Real part = (real(kPartedSteps) - steps) * real(1.0f / (kPartedSteps - kJoinedSteps));
  Truth surface = leaf_less(leaf_max(a, b), leaf_inf());
  return leaf_where(surface, leaf_min(leaf_max(part, real(0.0f)), real(1.0f)));
}

// The run on one side of a texel, from that of its neighbour on this side.
LEAF(Real) run_beside(Real of_neighbour, Real joined) {
  return joined * (of_neighbour + real(1.0f));
}

// Where matter ends that begins at `depth` and is as thick as the lesser of two runs, each with
// that of both sides and the texel itself.
LEAF(Real)
back_of_runs(Real depth, Real across, Real down, Real scale_x, Real scale_y, bool parallel) {
  Real width = leaf_min(across * scale_x, down * scale_y);
  return depth + (parallel ? width : width * depth);
}
