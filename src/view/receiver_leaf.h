// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after view/taps_leaf.h. No include guard, for
// it is included once per SIMD target. A pixel whose neighbours are fetched as single texels.

// A tap can lie this many pixels away, more than any image is wide; it keeps coordinates finite.
const float kMaxReach = 131072.0f;

// A camera's numbers (obscura/camera.h) and the radius in world units.
struct TapView {
  Real scale_x, scale_y, center_u, center_v;
  Real reach_x, reach_y;  // the radius in pixels at depth 1
  bool parallel;          // view rays
};

struct TapReceiver {
  Real z;
  Real distance;          // z, or 1 where rays are parallel
  Real perspective;       // 1, or 0 where rays are parallel
  Real reach_x, reach_y;  // the radius in pixels
  Real a, b;              // the receiver's ray (a, b, -1)
  Real scale_x, scale_y, step_a, step_b;
  Real nx, ny, nz;                // the normal, bent to face the camera
  Real facing, plane_x, plane_y;  // n.r < 0, and n.x, n.y times a pixel's size
};

// Of the pixel in column x and row y of the whole image.
LEAF(TapReceiver) make_tap_receiver(LEAF_IN(TapView) v, Real x, Real y, Real z) {
  TapReceiver r;
  r.z = z;
  r.distance = v.parallel ? real(1.0f) : z;
  r.perspective = real(v.parallel ? 0.0f : 1.0f);
  // One division: it is what a pixel costs most for.
  Real per_distance = real(1.0f) / leaf_max(r.distance, real(1e-37f));
  r.reach_x = leaf_min(v.reach_x * per_distance, real(kMaxReach));
  r.reach_y = leaf_min(v.reach_y * per_distance, real(kMaxReach));
  r.scale_x = v.scale_x;
  r.scale_y = v.scale_y;
  r.step_a = r.perspective * r.scale_x;
  r.step_b = r.perspective * r.scale_y;
  r.a = r.step_a * (x - (v.center_u - real(0.5f)));
  r.b = r.perspective * ((v.center_v - (y + real(0.5f))) * v.scale_y);
  r.nx = real(0.0f);
  r.ny = real(0.0f);
  r.nz = real(0.0f);
  r.facing = real(0.0f);
  r.plane_x = real(0.0f);
  r.plane_y = real(0.0f);
  return r;
}

// Prepares the tangent plane; the normal is bent to face the camera.
LEAF(void) set_tap_normal(Real nx, Real ny, Real nz, LEAF_INOUT(TapReceiver) r) {
  Real facing = leaf_fma(nx, r.a, leaf_fms(ny, r.b, nz));
  Real bend = bend_to_camera(facing, r.a, r.b);
  r.nx = leaf_nfma(bend, r.a, nx);
  r.ny = leaf_nfma(bend, r.b, ny);
  r.nz = nz + bend;
  r.facing = leaf_min(facing, real(kEdgeOn));
  r.plane_x = r.nx * r.scale_x;
  r.plane_y = r.ny * r.scale_y;
}

// The tangent plane and the ray r' = (a', b', -1) of the texel (kx, ky) pixels away, y down, or
// (0, 0, -1) where rays are parallel: `q` is n.(r - r') or its like, `slope` n.r'. The plane's
// depth on r' is z + distance q / slope if slope < 0; otherwise the ray does not hit it in front of
// the camera. The point at depth z + t on r' is at height t slope - distance q above the plane.
struct TexelPlane {
  Real q, slope;
};
LEAF(TexelPlane) plane_at(LEAF_IN(TapReceiver) r, Real kx, Real ky) {
  TexelPlane p;
  p.q = leaf_fms(r.plane_y, ky, r.plane_x * kx);
  p.slope = leaf_nfma(r.perspective, p.q, r.facing);
  return p;
}

// The texel's ray.
LEAF(Real) texel_ray_a(LEAF_IN(TapReceiver) r, Real kx) { return leaf_fma(kx, r.step_a, r.a); }
LEAF(Real) texel_ray_b(LEAF_IN(TapReceiver) r, Real ky) { return leaf_nfma(ky, r.step_b, r.b); }

// How much deeper than its front the back of an occluder lies that is `thickness` thick along the
// texel's ray.
LEAF(Real) thickness_at(LEAF_IN(TapReceiver) r, Real kx, Real ky, Real thickness) {
  return depth_of_thickness(thickness, texel_ray_a(r, kx), texel_ray_b(r, ky));
}
