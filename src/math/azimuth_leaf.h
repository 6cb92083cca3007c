// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target. The frame of an azimuthal slice, in the coordinates of math/azimuth-inl.h.

// The part along the ray of an image direction (u, v).
LEAF(Real) part_along_ray(Real a, Real b, Real inverse_length, Real u, Real v) {
  return leaf_fma(u, a, v * b) * inverse_length;
}

// The length of the part at right angles to it; `square` is u^2 + v^2.
LEAF(Real) part_across_ray(Real along, Real square) {
  return leaf_sqrt(leaf_max(leaf_nfma(along, along, square), real(1e-30f)));
}

// The angle around the zenith between two image directions, w_k of equation 2, from their parts
// along the ray, the area between them and their dot product.
LEAF(Real) angle_around_ray(Real inverse_length, Real low, Real high, Real area, Real product) {
  Real across = inverse_length * area;
  Real along = leaf_nfma(low, high, product);
  Real length = leaf_sqrt(leaf_max(leaf_fma(along, along, across * across), real(1e-30f)));
  return fast_acos(along / length);
}
