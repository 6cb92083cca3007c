// Leaf functions, C++ and GLSL: see math/leaf-inl.h. Normals of a depth image (view/normals.h).

// Change of depth per pixel towards the side where it is smaller (forward if equal), relative to
// the neighbour's depth in perspective; 0 where both sides are background, as if the surface faced
// the camera.
LEAF(Real) depth_step(Real backward, Real here, Real forward, bool relative) {
  Real db = here - backward, df = forward - here;
  Truth ahead = leaf_less_equal(leaf_abs(df), leaf_abs(db));
  Real change = leaf_select(ahead, df, db);
  Real scale = relative ? leaf_select(ahead, forward, backward) : real(1.0f);
  return leaf_where(leaf_less(leaf_abs(change), leaf_inf()), change / scale);
}

struct EyeNormal {
  Real x, y, z;
};
// The cross product of the two differences, divided by both neighbours' depths. With points
// ((u-cu) sx d, (cv-v) sy d, -d) it faces the camera by construction: n.(a, b, -1) < 0.
LEAF(EyeNormal)
normal_of_steps(Real du, Real dv, Real a, Real b, Real scale_x, Real scale_y, bool relative) {
  EyeNormal n;
  n.x = du * scale_y;
  n.y = leaf_neg(dv) * scale_x;
  n.z = scale_x * scale_y + (relative ? a * n.x + b * n.y : real(0.0f));
  return n;
}

// Made unit; (0, 0, 1) where it has no length or there is no surface.
LEAF(EyeNormal) unit_normal(LEAF_IN(EyeNormal) n, Truth surface) {
  Real largest = leaf_max(leaf_max(leaf_abs(n.x), leaf_abs(n.y)), leaf_abs(n.z));
  Truth known =
      leaf_both(surface, leaf_both(leaf_less(real(0.0f), largest), leaf_less(largest, leaf_inf())));
  Real k = real(1.0f) / largest;
  Real x = n.x * k, y = n.y * k, z = n.z * k;
  Real inverse = real(1.0f) / leaf_sqrt(x * x + y * y + z * z);
  EyeNormal unit;
  unit.x = leaf_where(known, x * inverse);
  unit.y = leaf_where(known, y * inverse);
  unit.z = leaf_select(known, z * inverse, real(1.0f));
  return unit;
}
