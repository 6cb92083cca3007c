// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/sectors_leaf.h and
// math/horizon_leaf.h, in C++ within a class. The obscurance of one azimuthal slice whose matter
// has an end: points may come in any number of separate pieces, and light passes between and below
// them.

// Directions between two edges, per unit of the obscurance between them: of the whole piece, or at
// its middle where it is so thin that differences are noise.
struct Between {
  Real x, y, solid;
};
LEAF(Between)
directions_between(LEAF_IN(Slice) s, LEAF_IN(SectorEdge) low, LEAF_IN(SectorEdge) high) {
  Real mx = low.sine + high.sine, my = low.cosine + high.cosine;
  Real length = leaf_inverse_sqrt(leaf_max(leaf_fma(mx, mx, my * my), real(1e-12f)));
  mx = mx * length;
  my = my * length;
  Real scale = real(1.0f);
  if (kSums == kSumUniform) {
    Real lobe = leaf_fma(s.nz, my, s.nt * mx);
    scale = leaf_reciprocal(leaf_max(lobe, real(0.05f)));
  }
  Real whole_x = along_tangent(s, high.sine, high.cosine, high.angle) -
                 along_tangent(s, low.sine, low.cosine, low.angle);
  Real whole_y = along_zenith(s, high.sine, high.cosine) - along_zenith(s, low.sine, low.cosine);
  Real between = cosine_integral(s.nz, s.nt, high.sine, high.cosine, high.angle) -
                 cosine_integral(s.nz, s.nt, low.sine, low.cosine, low.angle);
  Truth thin = leaf_less(between, real(1e-3f));
  Real inverse = leaf_reciprocal(leaf_max(between, real(kTiny)));
  Between b;
  b.x = leaf_select(thin, mx * scale, whole_x * inverse);
  b.y = leaf_select(thin, my * scale, whole_y * inverse);
  b.solid = leaf_select(thin, scale, (low.cosine - high.cosine) * inverse);
  return b;
}

// Sectors of a piece for which rho at its middle alone is enough; that of more is its halves' mean.
const float kNarrowPiece = 4.0f;

// Of a sector: what rounding may do to a place.
const float kSectorSlack = 0.01f;

// rho of a line's matter at a share t of the chord between two directions.
LEAF(Real)
rho_between_edges(LEAF_IN(MatterLine) line, LEAF_IN(SectorEdge) low, LEAF_IN(SectorEdge) high,
                  Real t) {
  Real wx = leaf_fma(t, high.sine - low.sine, low.sine);
  Real wy = leaf_fma(t, high.cosine - low.cosine, low.cosine);
  Real length = leaf_inverse_sqrt(leaf_max(leaf_fma(wx, wx, wy * wy), real(kTiny)));
  return rho_of(distance_to_line(line, length * across_line(line, wx, wy)));
}

// Marks what of the sectors between two edges is fresh, of those in `among`, and adds its part of
// rho of the line. What reaches above all before is new above that only.
LEAF(void)
mark_sectors(LEAF_IN(Slice) s, LEAF_IN(MatterLine) line, LEAF_IN(SectorEdge) low,
             LEAF_IN(SectorEdge) high, Bits among, Real dither, Truth valid,
             LEAF_INOUT(Sectors) m) {
  Bits mine = leaf_bits_where(valid, leaf_except(leaf_bits_below(high.place + dither),
                                                 leaf_bits_below(low.place + dither)));
  Bits fresh = leaf_except(leaf_intersection(mine, among), m.covered);
  if (!leaf_any_bit(fresh)) return;
  Real count = leaf_count_bits(fresh);
  Truth counts = leaf_less(real(0.0f), count);
  Truth wide = leaf_less(real(kNarrowPiece), high.place - low.place);
  Real mean = rho_between_edges(line, low, high, leaf_select(wide, real(0.25f), real(0.5f)));
  if (leaf_any(wide)) {
    Real other = rho_between_edges(line, low, high, real(0.75f));
    mean = leaf_select(wide, real(0.5f) * (mean + other), mean);
  }
  Real piece = (count * m.each) * mean;
  m.sum = m.sum + leaf_where(counts, piece);
  if (kSums != kSumVisibility) {
    Truth above = leaf_both(leaf_less(low.place, m.top.place), leaf_less(m.top.place, high.place));
    Between w = directions_between(s, low, select_sector_edge(above, m.top, high));
    m.sum_x = m.sum_x + leaf_where(counts, piece * w.x);
    m.sum_y = m.sum_y + leaf_where(counts, piece * w.y);
    m.sum_solid = m.sum_solid + leaf_where(counts, piece * w.solid);
  }
  m.covered = leaf_union(m.covered, fresh);
}

// The end of a box, where that is above what is covered all the way down.
LEAF(SectorEdge)
find_end(LEAF_IN(Slice) s, LEAF_IN(MatterBox) box, Truth needed, LEAF_IN(Sectors) m) {
  SectorEdge end = m.full;
  Sight sight = sight_of(box.end_x, box.end_y);
  if (leaf_any(leaf_both(needed, leaf_less(m.full.cosine, sight.cosine)))) {
    end = find_sector(s, m, box.end_x, sight);
  }
  return end;
}

// Where the corner of a box's front stands that is nearest to the zenith: in front of the receiver
// its near side, behind it the far one.
LEAF(Real) front_corner(Real x, Real y, Real reach) {
  return leaf_max(leaf_if_negative(y, x + reach, x - reach), real(0.0f));
}
// The direction of the point before, no farther from the zenith than where all is covered.
LEAF(SectorEdge) last_edge(LEAF_IN(Sectors) m) {
  return select_sector_edge(leaf_less(m.last.place, m.full.place), m.last, m.full);
}

// Adds the next point outwards. It fills what is between the corners of its box, and where it
// touches the matter of the point before (is `next` to it and within `slack` of depth), what is
// between the two: there a surface goes on, without the box's step. `dither` in [-0.5, 0.5) moves
// the rounding of edges to sectors, so that many slices round without bias.
LEAF(void)
add_matter(LEAF_IN(Slice) s, LEAF_IN(MatterBox) box, Truth next, Real slack, Real dither,
           Truth valid, LEAF_INOUT(Sectors) m) {
  Real x = box.x, y = box.y;
  Real gap = leaf_max(box.depth, m.depth) - leaf_min(box.back, m.back);
  Truth joined = leaf_both(m.joined, leaf_both(next, leaf_less_equal(gap, slack)));
  Real front_x = leaf_select(joined, x, front_corner(x, y, box.reach));
  Sight sight = sight_of(front_x, y);
  // Whether this covers anything new. What hardly rises above what is covered, as all of a plane
  // does, is left to the next that does.
  Truth rises =
      leaf_both(valid, leaf_either(leaf_less(m.full.cosine + real(kHorizonSlack), sight.cosine),
                                   leaf_both(joined, leaf_less(m.last.place, m.full.place))));
  SectorEdge front = m.full;
  if (leaf_any(rises)) {
    SectorEdge last = last_edge(m);
    front = select_sector_edge(rises, find_sector(s, m, front_x, sight), front);
    SectorEdge high = find_end(s, box, rises, m);  // farthest from the zenith
    SectorEdge low =
        select_sector_edge(leaf_both(joined, leaf_less(last.place, front.place)), last, front);
    high = select_sector_edge(leaf_both(joined, leaf_less(high.place, last.place)), last, high);
    mark_sectors(s, matter_line(s, m.x, m.y, x, y, joined), low, high, leaf_all_bits(), dither,
                 rises, m);
    Truth down = leaf_both(rises, leaf_less(m.full.place, high.place + real(kSectorSlack)));
    m.full = select_sector_edge(down, low, m.full);
    if (kSums != kSumVisibility) {
      m.top = select_sector_edge(leaf_both(rises, leaf_less(low.place, m.top.place)), low, m.top);
    }
  }
  m.x = leaf_select(valid, x, m.x);
  m.y = leaf_select(valid, y, m.y);
  m.depth = leaf_select(valid, box.depth, m.depth);
  m.last_row = leaf_select(valid, box.last_row, m.last_row);
  m.last.place = leaf_select(valid, real(kSectors), m.last.place);
  m.joined = valid;
  m.back = leaf_select(valid, box.back, m.back);
  m.last = select_sector_edge(rises, front, m.last);
}

// Adds matter that fills a `share` of its box only, evenly; `turn` tells apart which sectors it
// takes, so that what two of them cover is as good as independent. The surface before goes on
// behind it.
LEAF(void)
add_spread(LEAF_IN(Slice) s, LEAF_IN(MatterBox) box, Real share, Real dither, int turn, Truth valid,
           LEAF_INOUT(Sectors) m) {
  Real corner = front_corner(box.x, box.y, box.reach);
  Sight sight = sight_of(corner, box.y);
  Truth rises = leaf_both(valid, leaf_less(m.full.cosine, sight.cosine));
  if (!leaf_any(rises)) return;
  SectorEdge low = find_sector(s, m, corner, sight);
  SectorEdge high = find_end(s, box, rises, m);
  Bits among = leaf_spread_bits(leaf_fma(share, real(kSectors), dither), turn);
  mark_sectors(s, view_line(s, box.x, box.y), low, high, among, dither, rises, m);
}
