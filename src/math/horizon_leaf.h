// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/slice_leaf.h and with rho_of(),
// kChord and kSums, in C++ within a class that has them. The obscurance of one azimuthal slice,
// piece by piece (far-field ambient obscurance, equations 2 and 3). Points come from the receiver
// outwards; one is visible when its theta is smaller than every earlier one's. It then fills the
// directions from its own theta up to the smallest before it.

// Antiderivatives at theta of the summed directions, along the tangent and the zenith.
LEAF(Real) along_tangent(LEAF_IN(Slice) s, Real sine, Real cosine, Real angle) {
  if (kSums == kSumUniform) return uniform_along(sine, cosine, angle);
  return weighted_along(s.nz, s.nt, sine, cosine);
}
LEAF(Real) along_zenith(LEAF_IN(Slice) s, Real sine, Real cosine) {
  if (kSums == kSumUniform) return uniform_zenith(sine);
  return weighted_zenith(s.nz, s.nt, sine, cosine);
}

LEAF(Horizon) start_horizon(LEAF_IN(Slice) s, bool from_receiver) {
  Real zero = real(0.0f);
  Horizon h;
  h.cosine = real(-2.0f);
  h.slack = real(kHorizonSlack);
  h.edge = hemisphere_end(s);
  h.x = zero;
  h.y = zero;
  h.chord = leaf_truth(from_receiver);
  h.integral_x = zero;
  h.integral_y = zero;
  if (kSums != kSumVisibility) {
    h.integral_x = along_tangent(s, h.edge.sine, h.edge.cosine, h.edge.angle);
    h.integral_y = along_zenith(s, h.edge.sine, h.edge.cosine);
  }
  h.sum = zero;
  h.sum_x = zero;
  h.sum_y = zero;
  h.sum_solid = zero;
  return h;
}

// A Gauss node in the direction (wx, wy): its weight, and its weight times rho.
LEAF(void)
add_node(LEAF_IN(Slice) s, LEAF_IN(MatterLine) line, Real wx, Real wy, Real gauss,
         LEAF_INOUT(Real) weights, LEAF_INOUT(Real) values) {
  Real lobe = wx * leaf_fma(s.nz, wy, s.nt * wx);
  Real w = leaf_max(lobe, real(1e-12f)) * gauss;
  weights = weights + w;
  values = leaf_fma(w, rho_of(distance_to_line(line, across_line(line, wx, wy))), values);
}

// rho averaged over the piece between the horizon and the point (x, y) that is seen at `e`, by
// three Gauss points, each with its share of the integral.
LEAF(Real) mean_rho(LEAF_IN(Slice) s, LEAF_IN(Horizon) h, Real x, Real y, LEAF_IN(Edge) e) {
  MatterLine line = view_line(s, x, y);
  if (kChord) line = matter_line(s, h.x, h.y, x, y, h.chord);
  Real mx = h.edge.sine + e.sine, my = h.edge.cosine + e.cosine;
  Real scale = leaf_inverse_sqrt(leaf_max(leaf_fma(mx, mx, my * my), real(kTiny)));
  mx = mx * scale;
  my = my * scale;
  Real half_piece = real(0.5f) * (h.edge.angle - e.angle);
  Real weights = real(0.0f), values = real(0.0f);
  add_node(s, line, mx, my, real(8.0f / 9.0f), weights, values);
  Truth large = leaf_less_equal(real(kSmallPiece), half_piece);
  if (leaf_any(large)) {
    // Nothing in the other lanes, which the middle serves: no pixel depends on its neighbours.
    Real side = leaf_where(large, real(5.0f / 9.0f));
    Real ds, dc;
    leaf_sin_cos(half_piece * real(0.774596669f), ds, dc);
    add_node(s, line, leaf_fma(mx, dc, my * ds), leaf_nfma(mx, ds, my * dc), side, weights, values);
    add_node(s, line, leaf_nfma(my, ds, mx * dc), leaf_fma(mx, ds, my * dc), side, weights, values);
  }
  return values * leaf_reciprocal(weights);
}

// Adds the next point outwards. `share` is the part of the slice's width in which the point stands,
// 1 unless `partial`: the rest stays open, and the horizon moves by that part only.
LEAF(void)
add_point(LEAF_IN(Slice) s, Real x, Real y, Truth valid, bool partial, Real share,
          LEAF_INOUT(Horizon) h) {
  Real one = real(1.0f), zero = real(0.0f);
  Real inverse = leaf_inverse_sqrt(leaf_max(leaf_fma(x, x, y * y), real(kTiny)));
  Real cosine = y * inverse;
  Truth visible = leaf_both(valid, leaf_less(h.cosine, cosine));
  // What hardly raises the horizon, as all of a plane does, is left to the next point that does;
  // but a share of the width must move it by that share.
  Truth raises = leaf_less(h.edge.cosine + real(kLeastRise), cosine);
  if (partial) raises = leaf_either(raises, leaf_less(share, one));
  Truth moves = leaf_both(visible, raises);
  Real horizon = cosine;
  if (leaf_any(moves)) {
    horizon = leaf_min(cosine, one);
    Real angle = fast_acos(horizon), along_x = zero, along_y = zero;
    Edge e = clip_to_hemisphere(s, x * inverse, horizon, angle);
    if (kSums != kSumVisibility) {
      along_x = along_tangent(s, e.sine, e.cosine, e.angle);
      along_y = along_zenith(s, e.sine, e.cosine);
    }
    Real weight = leaf_where(moves, leaf_max(h.edge.integral - e.integral, zero));
    Truth counts = leaf_less(zero, weight);
    if (leaf_any(counts)) {
      Real mean = mean_rho(s, h, x, y, e);
      if (partial) mean = mean * share;
      h.sum = h.sum + leaf_where(counts, weight * mean);
      if (kSums != kSumVisibility) {
        h.sum_x = h.sum_x + leaf_where(counts, (h.integral_x - along_x) * mean);
        h.sum_y = h.sum_y + leaf_where(counts, (h.integral_y - along_y) * mean);
      }
      if (kSums == kSumUniform) {
        h.sum_solid = h.sum_solid + leaf_where(counts, (e.cosine - h.edge.cosine) * mean);
      }
    }
    if (partial) {
      Truth part = leaf_both(visible, leaf_less(share, one));
      if (leaf_any(part)) {
        // The horizon of the slice as a whole: the mean angle of its covered and its open part.
        Real before = fast_acos(leaf_max(h.cosine + h.slack, real(-1.0f)));
        Real between = leaf_fma(share, angle - before, before);
        Real half_sine, half_cosine;
        leaf_sin_cos(real(0.5f) * between, half_sine, half_cosine);
        Real mean_cosine = leaf_nfma(real(2.0f), half_sine * half_sine, one);
        Real mean_sine = real(2.0f) * (half_sine * half_cosine);
        horizon = leaf_select(part, mean_cosine, horizon);
        e = select_edge(part, clip_to_hemisphere(s, mean_sine, mean_cosine, between), e);
        if (kSums != kSumVisibility) {
          along_x = along_tangent(s, e.sine, e.cosine, e.angle);
          along_y = along_zenith(s, e.sine, e.cosine);
        }
      }
    }
    h.edge = select_edge(moves, e, h.edge);
    if (kSums != kSumVisibility) {
      h.integral_x = leaf_select(moves, along_x, h.integral_x);
      h.integral_y = leaf_select(moves, along_y, h.integral_y);
    }
  }
  Real slack = leaf_fma(real(kDepthSlack), s.camera * inverse, real(kHorizonSlack));
  h.cosine = leaf_select(visible, horizon - slack, h.cosine);
  h.slack = leaf_select(visible, slack, h.slack);
  h.x = x;
  h.y = y;
  h.chord = visible;
}
