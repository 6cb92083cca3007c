// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after screen/far_field/lattice_leaf.h. No
// include guard, for it is included once per SIMD target. Algorithm 1 in parallel lines.

// What a line has met within a strip: nearest depth, greatest slanted height and, of finite
// occluders, the depth where the nearest connected piece of matter ends and the outward coordinates
// (at depth 1, or in world units) of its first and last row.
struct Piece {
  Real nearest, slanted, deepest, begin, end;
};
LEAF(Piece) no_piece() {
  Piece p;
  p.nearest = leaf_inf();
  p.slanted = leaf_neg(leaf_inf());
  p.deepest = real(0.0f);
  p.begin = real(0.0f);
  p.end = real(0.0f);
  return p;
}
LEAF(Piece) select_piece(Truth t, LEAF_IN(Piece) yes, LEAF_IN(Piece) no) {
  Piece p;
  p.nearest = leaf_select(t, yes.nearest, no.nearest);
  p.slanted = leaf_select(t, yes.slanted, no.slanted);
  p.deepest = leaf_select(t, yes.deepest, no.deepest);
  p.begin = leaf_select(t, yes.begin, no.begin);
  p.end = leaf_select(t, yes.end, no.end);
  return p;
}

// `slope` is +1: m1 = max(x - depth), for a receiver that looks down; -1: the other way. `outward`
// is the row's coordinate at depth 1, or in world units.
LEAF(Real) slanted_height(Real slope, Real outward, Real depth, bool parallel) {
  return leaf_fms(slope, outward * (parallel ? real(1.0f) : depth), depth);
}

// Beside the background, or what lies apart, the nearer texel decides: a skirt that falls to
// infinity within one cell would spoil the averages. `nearer` is that texel's value.
LEAF(Real) between_texels(Real a, Real b, Real nearer, Real blend) {
  Real least = leaf_min(a, b);
  Truth both = leaf_both(leaf_less(real(0.0f), least), lies_beside(least, leaf_max(a, b)));
  return leaf_select(both, blended(a, b, blend), nearer);
}

LEAF(Piece) add_row(LEAF_IN(Piece) p, Truth surface, Real depth, Real height) {
  Piece q;
  q.nearest = leaf_min(p.nearest, leaf_select(surface, depth, leaf_inf()));
  q.slanted = leaf_max(p.slanted, leaf_select(surface, height, leaf_neg(leaf_inf())));
  q.deepest = p.deepest;
  q.begin = p.begin;
  q.end = p.end;
  return q;
}

// What a line has met of matter besides its nearest connected piece, summed up: where it begins and
// ends, and the lengths of its pieces along the view ray.
struct Rest {
  Real front, back, filled;
};
LEAF(Rest) no_rest() {
  Rest r;
  r.front = leaf_inf();
  r.back = real(0.0f);
  r.filled = real(0.0f);
  return r;
}
// `first` is the nearest depth of all; what lies apart from that is background.
LEAF(void) add_rest(LEAF_IN(Piece) p, Real first, LEAF_INOUT(Rest) r) {
  Truth counts = lies_beside(first, r.front);
  r.front = leaf_select(counts, r.front, leaf_inf());
  r.back = leaf_where(counts, r.back);
  r.filled = leaf_where(counts, r.filled);
  Truth there = leaf_both(leaf_less(p.nearest, leaf_inf()), lies_beside(first, p.nearest));
  r.front = leaf_min(r.front, leaf_select(there, p.nearest, leaf_inf()));
  r.back = leaf_max(r.back, leaf_where(there, p.deepest));
  r.filled = r.filled + leaf_where(there, p.deepest - p.nearest);
}
LEAF(Rest) merged_rest(LEAF_IN(Rest) a, LEAF_IN(Rest) b) {
  Rest r;
  r.front = leaf_min(a.front, b.front);
  r.back = leaf_max(a.back, b.back);
  r.filled = a.filled + b.filled;
  return r;
}
// The share of what lies between its ends that the rest fills; pieces may hide each other, so that
// it is at most this.
LEAF(Real) rest_share(LEAF_IN(Rest) r) {
  Real length = leaf_max(r.back - r.front, real(1e-30f));
  return leaf_min(r.filled / length, real(1.0f));
}

// What a line meets in a strip: of its connected pieces of matter the nearest, and the others.
struct Matter {
  Piece first;
  Rest rest;
};
LEAF(Matter) no_matter() {
  Matter m;
  m.first = no_piece();
  m.rest = no_rest();
  return m;
}
LEAF(void) add_piece_to(LEAF_IN(Piece) p, LEAF_INOUT(Matter) m) {
  Truth nearer = leaf_less(p.nearest, m.first.nearest);
  Piece other = select_piece(nearer, m.first, p);
  m.first = select_piece(nearer, p, m.first);
  add_rest(other, m.first.nearest, m.rest);
}

// The same while a strip is scanned: the piece that goes on, and the matter of the row before;
// none: infinity and 0.
struct MatterScan {
  Matter found;
  Piece piece;
  Real last, last_back;
};
LEAF(MatterScan) start_matter_scan() {
  MatterScan m;
  m.found = no_matter();
  m.piece = no_piece();
  m.last = leaf_inf();
  m.last_back = real(0.0f);
  return m;
}
LEAF(void)
add_matter_row(Truth surface, Real depth, Real back, Real height, Real outward, Real slack,
               LEAF_INOUT(MatterScan) m) {
  Real inf = leaf_inf();
  Truth joined = leaf_both(surface, matter_touches(depth, back, m.last, m.last_back, slack));
  // A piece that goes on is not compared yet: what is still to come belongs to it.
  add_piece_to(select_piece(joined, no_piece(), m.piece), m.found);
  Real nearest = leaf_select(joined, leaf_min(m.piece.nearest, depth), depth);
  m.piece.nearest = leaf_select(surface, nearest, inf);
  m.piece.slanted = leaf_select(joined, leaf_max(m.piece.slanted, height), height);
  m.piece.deepest = leaf_select(joined, leaf_max(m.piece.deepest, back), back);
  m.piece.begin = leaf_select(joined, m.piece.begin, outward);
  m.piece.end = leaf_select(surface, outward, m.piece.end);
  m.last = leaf_select(surface, depth, inf);
  m.last_back = leaf_where(surface, back);
}
LEAF(Matter) end_matter_scan(LEAF_IN(MatterScan) m) {
  Matter found = m.found;
  add_piece_to(m.piece, found);
  return found;
}

// Of two strips, the first one nearer to the edge at which lines begin.
LEAF(Piece) merged_strips(LEAF_IN(Piece) a, LEAF_IN(Piece) b) {
  Piece p;
  p.nearest = leaf_min(a.nearest, b.nearest);
  p.slanted = leaf_max(a.slanted, b.slanted);
  p.deepest = real(0.0f);
  p.begin = real(0.0f);
  p.end = real(0.0f);
  return p;
}
// Rows are `row` apart in outward coordinates.
LEAF(Matter) merged_matter(LEAF_IN(Matter) a, LEAF_IN(Matter) b, Real slack, Real row) {
  Piece p = a.first, q = b.first;
  Truth second = leaf_less(q.nearest, p.nearest);
  Piece front = select_piece(second, q, p);
  Real farther = leaf_max(p.nearest, q.nearest);
  Real gap = farther - leaf_min(p.deepest, q.deepest);
  Truth touches =
      leaf_both(leaf_less(farther, leaf_inf()), leaf_less_equal(gap, slack * front.nearest));
  Truth joined = leaf_both(touches, leaf_less(q.begin - p.end, real(kNextRow) * row));
  front.slanted = leaf_select(joined, leaf_max(p.slanted, q.slanted), front.slanted);
  front.deepest = leaf_select(joined, leaf_max(p.deepest, q.deepest), front.deepest);
  front.begin = leaf_select(joined, p.begin, front.begin);
  front.end = leaf_select(joined, q.end, front.end);
  Matter m;
  m.first = front;
  m.rest = a.rest;
  Rest other = b.rest;
  add_rest(no_piece(), front.nearest, other);
  add_rest(select_piece(joined, no_piece(), select_piece(second, p, q)), front.nearest, m.rest);
  m.rest = merged_rest(m.rest, other);
  return m;
}
