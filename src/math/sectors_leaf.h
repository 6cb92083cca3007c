// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/slice_leaf.h. No include guard, for
// it is included once per SIMD target. The hemisphere of a slice is cut into 32 sectors of equal
// cosine-weighted size, one bit each.
const float kSectors = 32.0f;

// A clipped direction and its place on the scale of sectors, 0 to 32.
struct SectorEdge {
  Real sine, cosine, angle, place;
};
LEAF(SectorEdge)
select_sector_edge(Truth t, LEAF_IN(SectorEdge) yes, LEAF_IN(SectorEdge) no) {
  SectorEdge e;
  e.sine = leaf_select(t, yes.sine, no.sine);
  e.cosine = leaf_select(t, yes.cosine, no.cosine);
  e.angle = leaf_select(t, yes.angle, no.angle);
  e.place = leaf_select(t, yes.place, no.place);
  return e;
}

// What a slice meets of a point's matter, a box on its view ray: its front from `reach` before (x,
// y) to `reach` behind it, and (end_x, end_y), the corner of its end that is farthest from the
// zenith. Its rows of texels count from the receiver, outwards.
struct MatterBox {
  Real x, y, reach;
  Real first_row, last_row;
  Real end_x, end_y;
  Real depth, back;  // where the matter begins and ends along the view ray
};

// The corner of a box's end, on the view rays of its front that goes from `before` to `behind`.
LEAF(void)
end_box(LEAF_IN(Slice) s, Real before, Real behind, bool parallel, LEAF_INOUT(MatterBox) box) {
  Real scale = parallel ? real(1.0f) : box.back * leaf_reciprocal(box.depth);
  box.end_y =
      parallel ? box.y - (box.back - box.depth) : leaf_fma(box.y - s.camera, scale, s.camera);
  box.end_x = leaf_if_negative(box.end_y, before, behind) * scale;
}

// What a slice's matter has covered so far (math/matter_leaf.h).
struct Sectors {
  Bits covered;
  Real first, per_span;    // F where the hemisphere begins, and 1 over F over all of it
  Real each;               // F over a sector
  Real x, y, depth, back;  // the point before: its place, and where its matter begins and ends
  Real last_row;
  SectorEdge last;  // its direction
  SectorEdge full;  // all that is farther from the zenith than this is covered
  Truth joined;     // there is a point before
  Real sum;
  Real sum_x, sum_y, sum_solid;  // directions, see SliceSums
  SectorEdge top;                // for them: nearest to the zenith so far
};
LEAF(Sectors) start_sectors(LEAF_IN(Slice) s, bool from_receiver, Real depth, Real back) {
  Real zero = real(0.0f);
  Edge end = hemisphere_end(s);
  Sectors m;
  m.covered = leaf_no_bits();
  m.first = leaf_if_negative(s.nz, s.edge_integral, zero);
  Real span = leaf_max(end.integral - m.first, real(1e-12f));
  m.per_span = leaf_reciprocal(span);
  m.each = span * real(1.0f / kSectors);
  m.x = zero;
  m.y = zero;
  m.depth = depth;
  m.back = back;
  m.last_row = zero;
  // What joins the receiver's own surface fills the slice down to its end.
  m.last.sine = end.sine;
  m.last.cosine = end.cosine;
  m.last.angle = end.angle;
  m.last.place = real(kSectors);
  m.full = m.last;
  m.top = m.last;
  m.joined = leaf_truth(from_receiver);
  m.sum = zero;
  m.sum_x = zero;
  m.sum_y = zero;
  m.sum_solid = zero;
  return m;
}

// How a point is seen: 1 over its distance, and the cosine of its zenith angle.
struct Sight {
  Real inverse, cosine;
};
LEAF(Sight) sight_of(Real x, Real y) {
  Sight sight;
  sight.inverse = leaf_inverse_sqrt(leaf_max(leaf_fma(x, x, y * y), real(kTiny)));
  sight.cosine = leaf_min(leaf_max(y * sight.inverse, real(-1.0f)), real(1.0f));
  return sight;
}
// The direction to a point, no farther from the zenith than where all is covered.
LEAF(SectorEdge)
find_sector(LEAF_IN(Slice) s, LEAF_IN(Sectors) m, Real x, LEAF_IN(Sight) sight) {
  Edge edge = clip_to_hemisphere(s, x * sight.inverse, sight.cosine, fast_acos(sight.cosine));
  Real unit = (edge.integral - m.first) * m.per_span;
  SectorEdge e;
  e.sine = edge.sine;
  e.cosine = edge.cosine;
  e.angle = edge.angle;
  e.place = real(kSectors) * leaf_max(unit, real(0.0f));
  return select_sector_edge(leaf_less(e.place, m.full.place), e, m.full);
}
