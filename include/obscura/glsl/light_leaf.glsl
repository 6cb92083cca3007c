// Light through visibility, bent normals and cones (obscura/lighting.h): the formulas, once for the
// CPU, for vulkan::LightRecorder and for an engine's own shader (obscura/glsl/ambient.glsl). The
// words (Real, LEAF, leaf_min, ...) are defined by whoever includes this.

struct LightVector {
  Real x, y, z;
};

LEAF(Real) light_dot(LEAF_IN(LightVector) a, LEAF_IN(LightVector) b) {
  return leaf_fma(a.x, b.x, leaf_fma(a.y, b.y, a.z * b.z));
}

// v / |v|, or `other` where v is zero or not finite.
LEAF(LightVector) light_unit(LEAF_IN(LightVector) v, LEAF_IN(LightVector) other) {
  // Divided by the largest component first, for squares of large ones overflow.
  Real largest = leaf_max(leaf_abs(v.x), leaf_max(leaf_abs(v.y), leaf_abs(v.z)));
  Real scale = real(1.0f) / largest;
  LightVector s;
  s.x = v.x * scale;
  s.y = v.y * scale;
  s.z = v.z * scale;
  Real square = light_dot(s, s);
  // A NaN or an infinity anywhere makes the square not finite; a good one is in [1, 3].
  Truth good = leaf_both(leaf_less(real(0.5f), square), leaf_less(square, real(3.5f)));
  Real inverse = real(1.0f) / leaf_sqrt(square);
  s.x = leaf_select(good, s.x * inverse, other.x);
  s.y = leaf_select(good, s.y * inverse, other.y);
  s.z = leaf_select(good, s.z * inverse, other.z);
  return s;
}

// Of an image: clamped to [0, 1]; NaN: 1.
LEAF(Real) light_visibility(Real v) {
  return leaf_select(leaf_less(v, real(1.0f)), leaf_max(v, real(0.0f)), real(1.0f));
}

const float kLightHalfPi = 1.57079632679f;

// Of an image: clamped to [0, pi/2]; NaN: pi/2.
LEAF(Real) light_angle(Real a) {
  return leaf_select(leaf_less(a, real(kLightHalfPi)), leaf_max(a, real(0.0f)),
                     real(kLightHalfPi));
}

// Where a direction hits the table of pre-convolved light, whose six faces have (cells + 1)^2
// vertices each, those on edges the same on both faces. Face 2k looks along axis k, face 2k + 1
// against it; its first coordinate runs along axis k + 1, its second along k + 2 (modulo 3).
struct LightCell {
  Real vertex;  // the cell's first; the others: + 1, + cells + 1, + cells + 2
  Real u, v;    // in [0, 1]
};
LEAF(LightCell) light_cell(Real cells, LEAF_IN(LightVector) w) {
  Real ax = leaf_abs(w.x);
  Real ay = leaf_abs(w.y);
  Real az = leaf_abs(w.z);
  Truth is_x = leaf_both(leaf_less_equal(ay, ax), leaf_less_equal(az, ax));
  Truth is_y = leaf_less_equal(az, ay);
  Real major = leaf_select(is_x, w.x, leaf_select(is_y, w.y, w.z));
  Real first = leaf_select(is_x, w.y, leaf_select(is_y, w.z, w.x));
  Real second = leaf_select(is_x, w.z, leaf_select(is_y, w.x, w.y));
  Real scale = real(0.5f) / leaf_abs(major);
  Real last = cells - real(1.0f);
  Real at_u = leaf_fma(first, scale, real(0.5f)) * cells;
  Real at_v = leaf_fma(second, scale, real(0.5f)) * cells;
  Real i = leaf_min(leaf_max(leaf_floor(at_u), real(0.0f)), last);
  Real j = leaf_min(leaf_max(leaf_floor(at_v), real(0.0f)), last);
  Real axis = leaf_select(is_x, real(0.0f), leaf_select(is_y, real(2.0f), real(4.0f)));
  Real face = axis + leaf_if_negative(major, real(1.0f), real(0.0f));
  Real side = cells + real(1.0f);
  LightCell cell;
  cell.vertex = leaf_fma(leaf_fma(face, side, j), side, i);
  cell.u = leaf_min(leaf_max(at_u - i, real(0.0f)), real(1.0f));
  cell.v = leaf_min(leaf_max(at_v - j, real(0.0f)), real(1.0f));
  return cell;
}

// Of a vertex' eight levels, cones of pi/16, 2 pi/16, ... pi/2, the two around an angle.
struct LightLevel {
  Real low, between;  // the wider one is low + 1; 0: low alone
};
LEAF(LightLevel) light_level(Real angle) {
  Real above = leaf_max(leaf_fms(angle, real(5.09295818f), real(1.0f)), real(0.0f));
  LightLevel level;
  level.low = leaf_min(leaf_floor(above), real(6.0f));
  level.between = leaf_min(above - level.low, real(1.0f));
  return level;
}

// What the table's light is multiplied with. `bend`: the cosine between bent normal and normal, in
// [0, 1]. `paper`: the paper's t over that of the table, sin^2(a) / (1 - cos a).
LEAF(Real)
light_scale(bool geometric_term, bool paper, Real visibility, Real bend, Real cone_cosine) {
  Real scale = visibility;
  if (geometric_term) scale = scale * bend;
  if (paper) scale = scale * (real(1.0f) + cone_cosine);
  return scale;
}

// The share of a sun that reaches a surface through a cone: the part of its disc inside the cone,
// linear in the angle between sun and axis, times the share of the cone that is open, which is
// visibility over that of the whole cone.
LEAF(Real)
light_sun_through_cone(bool uniform_weights, Real visibility, Real bend, Real angle,
                       Real cone_cosine, Real axis_sun, Real radius) {
  Real off = leaf_acos(leaf_min(leaf_max(axis_sun, real(-1.0f)), real(1.0f)));
  Real inside = (angle + radius - off) / (radius + radius);
  inside = leaf_min(leaf_max(inside, real(0.0f)), real(1.0f));
  Real whole = leaf_nfma(cone_cosine, cone_cosine, real(1.0f)) * bend;
  if (uniform_weights) whole = real(1.0f) - cone_cosine;
  Real open = visibility / leaf_max(whole, real(1e-4f));
  return inside * leaf_min(open, real(1.0f));
}
