// Leaf function, C++ and GLSL: see math/leaf-inl.h; in C++ within a class. Before this: kThickness
// and rho_integral(z, lateral), the integral of rho along a sample's line from the sphere's middle
// to depth offset z. Lengths are in the lines' unit.

// L = max(min(zs, d, zp) + zs, 0) (Loos and Sloan 2010, section 4.1), without the half from -zs to
// 0; zu is min(zs, zp). And what is free again behind the occluder (Loos and Sloan 2010,
// section 4.3).
LEAF(Real) open_line(Real offset, Real behind, Real zu, Real zs, Real lateral) {
  Real line = rho_integral(leaf_max(leaf_min(offset, zu), leaf_neg(zs)), lateral);
  if (kThickness) {
    Real back = leaf_max(leaf_min(offset + behind, zu), leaf_neg(zs));
    line = line + (rho_integral(zu, lateral) - rho_integral(back, lateral));
  }
  return line;
}
