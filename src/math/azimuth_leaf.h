// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target. The frame of an azimuthal slice around a receiver. Coordinates: u to the right, v
// down, w along the view; the receiver's ray is (a, b, 1) at depth 1, its zenith -ray/|ray|. An
// image direction (u, v) is in pixels times the size of a pixel at depth 1.

// The length of a ray (a, b, 1): depth times this is the distance from the camera.
LEAF(Real) length_of_ray(Real a, Real b) {
  return leaf_sqrt(leaf_fma(a, a, leaf_fma(b, b, real(1.0f))));
}

struct ViewRay {
  Real a, b, ray_length, inverse_length;
};
LEAF(ViewRay) make_ray(Real a, Real b) {
  ViewRay r;
  r.a = a;
  r.b = b;
  r.ray_length = length_of_ray(a, b);
  r.inverse_length = real(1.0f) / r.ray_length;
  return r;
}

// The part along the ray of an image direction (u, v).
LEAF(Real) part_along_ray(LEAF_IN(ViewRay) r, Real u, Real v) {
  return leaf_fma(u, r.a, v * r.b) * r.inverse_length;
}

struct Azimuth {
  Real along, across;  // the step's parts along the ray and at right angles to it (the tangent)
  Real nz, nt;         // the normal along zenith and tangent
};
LEAF(Azimuth)
make_azimuth(LEAF_IN(ViewRay) r, Real u, Real v, Real nu, Real nv, Real nw) {
  Azimuth s;
  s.along = part_along_ray(r, u, v);
  Real square = u * u + v * v;
  s.across = leaf_sqrt(leaf_max(leaf_nfma(s.along, s.along, square), real(1e-30f)));
  s.nz = leaf_neg(leaf_fma(nu, r.a, leaf_fma(nv, r.b, nw)) * r.inverse_length);
  s.nt = leaf_fma(s.nz, s.along, leaf_fma(nu, u, nv * v)) / s.across;
  return s;
}

// The angle around the zenith between two image directions: w_k of equation 2.
LEAF(Real)
azimuth_between(LEAF_IN(ViewRay) r, Real low_u, Real low_v, Real high_u, Real high_v) {
  Real area = leaf_abs(low_u * high_v - low_v * high_u);
  Real product = low_u * high_u + low_v * high_v;
  Real low = part_along_ray(r, low_u, low_v), high = part_along_ray(r, high_u, high_v);
  Real across = r.inverse_length * area;
  Real along = leaf_nfma(low, high, product);
  Real length = leaf_sqrt(leaf_max(leaf_fma(along, along, across * across), real(1e-30f)));
  return fast_acos(along / length);
}
