// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/azimuth_leaf.h. No include guard,
// for it is included once per SIMD target. The ray of a pixel is (a, b, -1).

// Normals that turn away from the camera more than this (times the ray's length) are bent back to
// it: a visible surface cannot face away, but an interpolated normal can.
const float kEdgeOn = -1e-4f;

// Relative precision of float depths. A surface that is nearer than another by less than this does
// not count as in front of it.
const float kDepthGrain = 1e-6f;

// How far along its ray, towards the camera, a normal n is bent with n.r = facing.
LEAF(Real) bend_to_camera(Real facing, Real a, Real b) {
  Real excess = leaf_max(facing - real(kEdgeOn), real(0.0f));
  return excess / leaf_fma(a, a, leaf_fma(b, b, real(1.0f)));
}

// How much deeper than its front the back of an occluder lies that is `thickness` thick along the
// ray.
LEAF(Real) depth_of_thickness(Real thickness, Real a, Real b) {
  return thickness / length_of_ray(a, b);
}

const float kFarBack = 1e12f;  // matter without end, finite so that arithmetic is

// The depth at which the matter of a texel ends whose ray is (a, b, 1): finite thickness is along
// the view ray.
LEAF(Real) back_of_thickness(Real depth, Real thickness, Real a, Real b, bool parallel) {
  Real behind = parallel ? thickness : depth_of_thickness(thickness, a, b);
  return leaf_min(depth + behind, real(kFarBack));
}

// Neighbours whose matter is this many pixels' footprints of depth apart still belong together: a
// surface seen at a grazing angle.
const float kJoinedPixels = 8.0f;
LEAF(Real) slack_of_pixels(Real scale_u, Real scale_v) {
  return real(kJoinedPixels) * leaf_max(scale_u, scale_v);
}
