// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after screen/horizon/lines_leaf.h and
// math/horizon_leaf.h, in C++ within a class.

// rho = 1 up to R: only the highest sample counts, the cosine of which this is.
LEAF(Obscured) finish_constant(LEAF_IN(Slice) s, Real highest) {
  Real cosine = leaf_min(highest, real(1.0f));
  Real sine = leaf_sqrt(leaf_nfma(cosine, cosine, real(1.0f)));
  Real angle = fast_acos(cosine);
  Obscured o;
  o.visibility = s.edge_integral - cosine_integral(s.nz, s.nt, sine, cosine, angle);
  o.solid = cosine - s.edge_cosine;
  o.along = real(0.0f);
  o.zenith = real(0.0f);
  if (kSums != kSumVisibility) {
    o.along = along_tangent(s, s.edge_sine, s.edge_cosine, s.edge_angle) -
              along_tangent(s, sine, cosine, angle);
    o.zenith = along_zenith(s, s.edge_sine, s.edge_cosine) - along_zenith(s, sine, cosine);
  }
  return o;
}
LEAF(Obscured) finish_falling(LEAF_IN(Horizon) h) {
  Obscured o;
  o.visibility = h.sum;
  o.solid = h.sum_solid;
  o.along = h.sum_x;
  o.zenith = h.sum_y;
  return o;
}
