// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after screen/volumetric/area/area_leaf.h, in
// C++ within a class. Before this: kQuadratic, kNormals, kThickness and rho_integral(z, lateral),
// the integral of rho along a sample's line from the sphere's middle to depth offset z.

// Loos and Sloan 2010, section 4.2: visibility is 1 up to mu - sigma and falls to 0 at mu + sigma,
// as a z + b with a = -1/(2 sigma), b = (mu + sigma)/(2 sigma). Integral of rho times it over [-zs,
// zs].
LEAF(Real) line_integral(Real mu, Real sigma, Real zs, Real half_line, Real lateral) {
  Real end = mu + sigma;
  Real lo = leaf_max(leaf_min(mu - sigma, zs), leaf_neg(zs));
  Real hi = leaf_max(leaf_min(end, zs), leaf_neg(zs));
  Real rho_lo = rho_integral(lo, lateral);
  Real ramp = constant_ramp(lo, hi, end);
  if (kQuadratic) {
    ramp = quadratic_ramp(lo, hi, end, rho_lo, rho_integral(hi, lateral), lateral);
  }
  return leaf_fma(ramp, leaf_reciprocal(sigma + sigma), rho_lo + half_line);
}

// Of the moments that the pyramid says under a sample, its share of surface, those of the tangent
// plane, and how much deeper than its front the occluder's back lies.
LEAF(SampleLine)
sample_line(Real mu, Real sigma, Real share, LEAF_IN(PlaneMoments) plane, Real behind, Real zs,
            Real half_line, Real lateral) {
  SampleLine s;
  s.bound = half_line + half_line;
  s.open = line_integral(mu, sigma, zs, half_line, lateral);
  if (kNormals) {
    Real slant = leaf_max(plane.deviation, real(kLeastDeviation));
    s.bound = line_integral(plane.mean, slant, zs, half_line, lateral);
    s.open = leaf_min(s.open, s.bound);
  }
  if (kThickness) {
    // And what is free again behind the occluder (Loos and Sloan 2010, section 4.3).
    Real back = leaf_min(mu + behind, real(kMaxOffset));
    Real free = leaf_min(line_integral(back, sigma, zs, half_line, lateral), s.bound);
    s.open = s.open + (s.bound - free);
  }
  // Background occludes nothing.
  s.open = leaf_fma(share, s.open - s.bound, s.bound);
  return s;
}
