// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/slab_leaf.h. No include guard, for
// it is included once per SIMD target.
//
// An azimuthal slice: the half-plane of the receiver (the origin), its zenith (towards the camera)
// and a tangent. A point is (x, y), x >= 0 along the tangent, y along the zenith. theta is measured
// from the zenith, so the direction theta is (sin theta, cos theta).

const float kTiny = 1e-30f;
const float kPiOfSlice = 3.14159265f, kHalfPiOfSlice = 1.57079633f;

// SliceSums.
const int kSumVisibility = 0, kSumUniform = 1, kSumCosine = 2;

// What a slice is before any point is seen.
struct Slice {
  Real nz, nt;  // the normal along zenith and tangent; n.w = nz cos theta + nt sin theta
  Real edge_sine, edge_cosine, edge_angle;  // where n.w = 0
  Real edge_integral;                       // F(edge)
  Real camera;                              // distance to the camera; 1 where rays are parallel
  Real perspective;                         // 1, or 0 where rays are parallel
};
LEAF(Slice) make_slice(Real nz, Real nt, Real camera, Real perspective) {
  Slice s;
  s.nz = nz;
  s.nt = nt;
  s.camera = camera;
  s.perspective = perspective;
  Real square = leaf_max(leaf_fma(nz, nz, nt * nt), real(kTiny));
  Real inverse = real(1.0f) / leaf_sqrt(square);
  s.edge_sine = leaf_abs(nz) * inverse;
  // -nt for a normal that faces the camera, nt for one that has turned away.
  s.edge_cosine = leaf_if_negative(nz, nt, leaf_neg(nt)) * inverse;
  s.edge_angle = fast_acos(s.edge_cosine);
  s.edge_integral = cosine_integral(nz, nt, s.edge_sine, s.edge_cosine, s.edge_angle);
  return s;
}

// A direction clipped to the hemisphere, and F there.
struct Edge {
  Real sine, cosine, angle, integral;
};
LEAF(Edge) select_edge(Truth t, LEAF_IN(Edge) yes, LEAF_IN(Edge) no) {
  Edge e;
  e.sine = leaf_select(t, yes.sine, no.sine);
  e.cosine = leaf_select(t, yes.cosine, no.cosine);
  e.angle = leaf_select(t, yes.angle, no.angle);
  e.integral = leaf_select(t, yes.integral, no.integral);
  return e;
}
LEAF(Edge) clip_to_hemisphere(LEAF_IN(Slice) s, Real sine, Real cosine, Real angle) {
  Truth outside = leaf_differ(leaf_less(s.nz, real(0.0f)), leaf_less_equal(cosine, s.edge_cosine));
  Edge e;
  e.sine = leaf_select(outside, s.edge_sine, sine);
  e.cosine = leaf_select(outside, s.edge_cosine, cosine);
  e.angle = leaf_select(outside, s.edge_angle, angle);
  e.integral =
      leaf_select(outside, s.edge_integral, cosine_integral(s.nz, s.nt, sine, cosine, angle));
  return e;
}
// Where the slice's hemisphere ends, below the receiver's surface.
LEAF(Edge) hemisphere_end(LEAF_IN(Slice) s) {
  Edge e;
  e.sine = leaf_if_negative(s.nz, real(0.0f), s.edge_sine);
  e.cosine = leaf_if_negative(s.nz, real(-1.0f), s.edge_cosine);
  e.angle = leaf_if_negative(s.nz, real(kPiOfSlice), s.edge_angle);
  e.integral = leaf_if_negative(s.nz, s.nt * real(kHalfPiOfSlice), s.edge_integral);
  return e;
}

// A line through a point, along which matter lies: where its edge stands along the tangent, its
// direction, and |point x direction|.
struct MatterLine {
  Real ex, ey, numerator;
};
// `chord`: between the point before (x0, y0) and (x, y) the surface goes on; else matter hangs
// along the view ray. Of a chord that rises by more than it goes outwards an edge stands between
// its ends, most likely halfway, and matter hangs below it away from the camera.
LEAF(MatterLine) matter_line(LEAF_IN(Slice) s, Real x0, Real y0, Real x, Real y, Truth chord) {
  Real outwards = x - x0, rise = y - y0;
  Truth edge =
      leaf_both(chord, leaf_both(leaf_less(real(0.0f), outwards), leaf_less(outwards, rise)));
  Truth whole = leaf_both(chord, leaf_not(edge));
  Real px = leaf_select(edge, leaf_nfma(real(0.5f), outwards, x), x);
  MatterLine line;
  line.ex = leaf_select(whole, outwards, px * s.perspective);
  line.ey = leaf_select(whole, rise, leaf_fms(y, s.perspective, s.camera));
  line.numerator = leaf_abs(leaf_fms(px, line.ey, y * line.ex));
  return line;
}
// The same where matter always hangs along the view ray.
LEAF(MatterLine) view_line(LEAF_IN(Slice) s, Real x, Real y) {
  MatterLine line;
  line.ex = x * s.perspective;
  line.ey = leaf_fms(y, s.perspective, s.camera);
  line.numerator = leaf_abs(leaf_fms(x, line.ey, y * line.ex));
  return line;
}
// The distance to a line in the direction (wx, wy): |p x e| / |w x e|.
LEAF(Real) distance_to_line(LEAF_IN(MatterLine) line, Real across) {
  Real distance = line.numerator * leaf_reciprocal(leaf_max(across, real(kTiny)));
  return leaf_min(distance, real(1e30f));
}
LEAF(Real) across_line(LEAF_IN(MatterLine) line, Real wx, Real wy) {
  return leaf_abs(leaf_fms(wx, line.ey, wy * line.ex));
}

// Of the horizon's cosine.
const float kLeastRise = 5e-4f;
// What lies this little below the horizon is visible: of a plane every point, whatever rounding
// does. The second part is of the distance to the camera, over that to the point: rounding of
// depths turns a point that is close by far more than one farther away. (Where rays are parallel
// the camera counts as 1 away.)
const float kHorizonSlack = 1e-5f;
const float kDepthSlack = 3e-7f;
// Half the angle of pieces for which the middle alone is enough.
const float kSmallPiece = 0.25f;

// The smallest theta so far, and what stands above it (math/horizon_leaf.h).
struct Horizon {
  Real cosine;  // of the smallest theta, less `slack`; -2 before the first point
  Real slack;   // what lies this little below the horizon is visible
  Edge edge;    // the same clipped to the hemisphere
  Real x, y;    // the point before
  Truth chord;  // the point before was visible
  Real sum;     // obscurance of the slice
  // Directions, see SliceSums.
  Real integral_x, integral_y;   // at the clipped theta
  Real sum_x, sum_y, sum_solid;  // along the tangent, the zenith; solid angle
};
