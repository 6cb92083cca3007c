// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/azimuth_leaf.h. Linear depth from
// other kinds of depth (DepthKind).

const float kFarthestDepth = 1e9f;  // obscura::kNoDepth: from here on nothing is there

// From the distance along the ray (a, b, -1).
LEAF(Real) depth_of_distance(Real distance, Real a, Real b) {
  return distance / length_of_ray(a, b);
}

// From NDC: `reversed` is 1 near and 0 far, `forward` the opposite; both keep precision at their
// own end. `endless`: far_plane is infinite.
LEAF(Real)
depth_of_ndc(Real reversed, Real forward, Real near_plane, Real far_plane, bool parallel,
             bool endless) {
  if (parallel) return near_plane * reversed + far_plane * forward;
  if (endless) return near_plane / reversed;
  return near_plane * far_plane / (near_plane * forward + far_plane * reversed);
}
