// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after screen/far_field/lattice_leaf.h. No
// include guard, for it is included once per SIMD target. Algorithm 1 in parallel lines.

// What a line has met within a strip: nearest depth, greatest slanted height and, of finite
// occluders, the depth where the nearest connected piece of matter ends.
struct Piece {
  Real nearest, slanted, deepest;
};
LEAF(Piece) no_piece() {
  Piece p;
  p.nearest = leaf_inf();
  p.slanted = leaf_neg(leaf_inf());
  p.deepest = real(0.0f);
  return p;
}
LEAF(Piece) select_piece(Truth t, LEAF_IN(Piece) yes, LEAF_IN(Piece) no) {
  Piece p;
  p.nearest = leaf_select(t, yes.nearest, no.nearest);
  p.slanted = leaf_select(t, yes.slanted, no.slanted);
  p.deepest = leaf_select(t, yes.deepest, no.deepest);
  return p;
}
LEAF(Piece) nearer_piece(LEAF_IN(Piece) a, LEAF_IN(Piece) b) {
  return select_piece(leaf_less(a.nearest, b.nearest), a, b);
}

// `slope` is +1: m1 = max(x - depth), for a receiver that looks down; -1: the other way. `outward`
// is the row's coordinate at depth 1, or in world units.
LEAF(Real) slanted_height(Real slope, Real outward, Real depth, bool parallel) {
  return leaf_fms(slope, outward * (parallel ? real(1.0f) : depth), depth);
}

// Beside the background the nearer texel decides: a skirt that falls to infinity within one cell
// would spoil the averages. `nearer` is that texel's value.
LEAF(Real) between_texels(Real a, Real b, Real nearer, Real blend) {
  Truth both = leaf_less(real(0.0f), leaf_min(a, b));
  return leaf_select(both, blended(a, b, blend), nearer);
}

// The same where matter has an end: between texels whose matter, at depths da and db, does not
// touch the nearer one decides.
LEAF(Real)
between_matter(Real a, Real b, Real nearer, Real blend, Real da, Real db, Real back_a, Real back_b,
               Real slack) {
  Truth both = leaf_both(leaf_less(real(0.0f), leaf_min(a, b)),
                         matter_touches(da, back_a, db, back_b, slack));
  return leaf_select(both, blended(a, b, blend), nearer);
}

LEAF(Piece) add_row(LEAF_IN(Piece) p, Truth surface, Real depth, Real height) {
  Piece q;
  q.nearest = leaf_min(p.nearest, leaf_select(surface, depth, leaf_inf()));
  q.slanted = leaf_max(p.slanted, leaf_select(surface, height, leaf_neg(leaf_inf())));
  q.deepest = p.deepest;
  return q;
}

// Of a line's connected pieces of matter the nearest, the piece that goes on, and the matter of the
// row before; none: infinity and 0.
struct MatterScan {
  Piece best, piece;
  Real last, last_back;
};
LEAF(MatterScan) start_matter_scan() {
  MatterScan m;
  m.best = no_piece();
  m.piece = no_piece();
  m.last = leaf_inf();
  m.last_back = real(0.0f);
  return m;
}
LEAF(void)
add_matter_row(Truth surface, Real depth, Real back, Real height, Real slack,
               LEAF_INOUT(MatterScan) m) {
  Real inf = leaf_inf();
  Truth joined = leaf_both(surface, matter_touches(depth, back, m.last, m.last_back, slack));
  // A piece that goes on is not compared yet: what is still to come belongs to it.
  Piece ended = m.piece;
  ended.nearest = leaf_select(joined, inf, m.piece.nearest);
  m.best = nearer_piece(ended, m.best);
  Real nearest = leaf_select(joined, leaf_min(m.piece.nearest, depth), depth);
  m.piece.nearest = leaf_select(surface, nearest, inf);
  m.piece.slanted = leaf_select(joined, leaf_max(m.piece.slanted, height), height);
  m.piece.deepest = leaf_select(joined, leaf_max(m.piece.deepest, back), back);
  m.last = leaf_select(surface, depth, inf);
  m.last_back = leaf_where(surface, back);
}

// Of two strips, the first one nearer to the edge at which lines begin.
LEAF(Piece) merged_strips(LEAF_IN(Piece) a, LEAF_IN(Piece) b) {
  Piece p;
  p.nearest = leaf_min(a.nearest, b.nearest);
  p.slanted = leaf_max(a.slanted, b.slanted);
  p.deepest = real(0.0f);
  return p;
}
LEAF(Piece) merged_matter(LEAF_IN(Piece) a, LEAF_IN(Piece) b, Real slack) {
  Piece front = nearer_piece(b, a);
  Real farther = leaf_max(a.nearest, b.nearest);
  Real gap = farther - leaf_min(a.deepest, b.deepest);
  Truth joined =
      leaf_both(leaf_less(farther, leaf_inf()), leaf_less_equal(gap, slack * front.nearest));
  front.slanted = leaf_select(joined, leaf_max(a.slanted, b.slanted), front.slanted);
  front.deepest = leaf_select(joined, leaf_max(a.deepest, b.deepest), front.deepest);
  return front;
}
