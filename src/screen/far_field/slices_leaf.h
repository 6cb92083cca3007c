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

// Where the matter of the point (x, y) at `depth` ends, on the same view ray.
struct MatterEnd {
  Real x, y;
};
LEAF(MatterEnd)
matter_end(LEAF_IN(Part) p, Real x, Real y, Real depth, Real back, bool parallel) {
  Real scale = back * leaf_reciprocal(depth);
  Real camera = p.slice.camera;
  MatterEnd e;
  e.x = parallel ? x : x * scale;
  e.y = parallel ? y - (back - depth) : leaf_fma(y - camera, scale, camera);
  return e;
}

// A sum along the slice's tangent and zenith, weighted by w_k: the tangent is
// (middle - along ray/|ray|) / across and the zenith -ray/|ray|, so these are its shares of
// `middle` and, negated, of ray/|ray|, which all slices of a receiver have in common.
LEAF(Real) share_of_middle(LEAF_IN(Part) p, Real sum_x) { return p.width * sum_x / p.across; }
LEAF(Real) share_of_ray(LEAF_IN(Part) p, Real sum_y, Real of_middle) {
  return leaf_fma(p.width, sum_y, of_middle * p.along);
}

// A direct sample of finite matter: blended between four texels of one surface, a and b in one row,
// c and e in the next, otherwise `nearest` of them, which is `nearest_back` deep. That one stands
// at its own row only: taken at several places it would be a step of the height of a texel in every
// surface that is not blended, which rods and edges would cast on themselves.
struct MatterTap {
  Real depth, back;
  Truth smooth_here, surface;
};
LEAF(MatterTap)
matter_tap(Real a, Real b, Real c, Real e, Real wu, Real wv, Real nearest, Real nearest_back,
           Real first_back, Real slack, Real ortho_offset, bool parallel) {
  Real tiny = real(kSmallest);
  Real between = blended(blended(a, b, wu), blended(c, e, wu), wv);
  Real least = leaf_min(leaf_min(a, b), leaf_min(c, e));
  Real most = leaf_max(leaf_max(a, b), leaf_max(c, e));
  Real far = near_depth_of_lattice(leaf_max(least, tiny), ortho_offset, parallel);
  Real near = near_depth_of_lattice(leaf_max(most, tiny), ortho_offset, parallel);
  MatterTap t;
  t.smooth_here =
      leaf_both(leaf_less(real(0.0f), least), leaf_less_equal(far - first_back, slack * near));
  Real g = leaf_select(t.smooth_here, between, nearest);
  t.depth = near_depth_of_lattice(leaf_max(g, tiny), ortho_offset, parallel);
  t.back = leaf_max(nearest_back, t.depth);
  t.surface = leaf_less(real(0.0f), g);
  return t;
}
