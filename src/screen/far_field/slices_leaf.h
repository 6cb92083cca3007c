// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/slice_leaf.h and
// screen/far_field/lattice_leaf.h. No include guard, for it is included once per SIMD target.

// A receiver and the slice of one segment around it. A point whose major coordinate is `rows`
// outwards (in perspective: times its depth) on the segment's middle line lies at p - receiver =
// (depth' - depth) (a, b, 1) + rows middle; the slice's frame is the zenith -ray/|ray| and, as
// tangent, the part of `middle` at right angles to it.
struct Part {
  Slice slice;
  Real depth, ray_length;
  Real along, across;  // the middle's parts along the ray and across it
  Real width;          // w_k: the angle around the zenith between the segment's edges
};
// (nu, nv, nw) is the normal; middle, low and high are the segment's slopes one row outwards.
LEAF(Part)
make_part(LEAF_IN(ViewRay) ray, Real depth, Real nu, Real nv, Real nw, Real middle_u, Real middle_v,
          Real low_u, Real low_v, Real high_u, Real high_v, bool parallel) {
  Azimuth azimuth = make_azimuth(ray, middle_u, middle_v, nu, nv, nw);
  Part p;
  p.depth = depth;
  p.ray_length = ray.ray_length;
  p.along = azimuth.along;
  p.across = azimuth.across;
  Real camera = parallel ? real(1.0f) : depth * ray.ray_length;
  p.slice = make_slice(azimuth.nz, azimuth.nt, camera, real(parallel ? 0.0f : 1.0f));
  p.width = azimuth_between(ray, low_u, low_v, high_u, high_v);
  return p;
}

// A point in the slice's frame.
LEAF(Real) part_x(LEAF_IN(Part) p, Real rows) { return leaf_abs(rows * p.across); }
LEAF(Real) part_y(LEAF_IN(Part) p, Real point_depth, Real rows) {
  return leaf_nfma(rows, p.along, p.ray_length * (p.depth - point_depth));
}

// A sum along the slice's tangent and zenith, weighted by w_k: the tangent is
// (middle - along ray/|ray|) / across and the zenith -ray/|ray|, so these are its shares of
// `middle` and, negated, of ray/|ray|, which all slices of a receiver have in common.
LEAF(Real) share_of_middle(LEAF_IN(Part) p, Real sum_x) { return p.width * sum_x / p.across; }
LEAF(Real) share_of_ray(LEAF_IN(Part) p, Real sum_y, Real of_middle) {
  return leaf_fma(p.width, sum_y, of_middle * p.along);
}
