// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/slab_leaf.h. No include guard, for
// it is included once per SIMD target. Bent cones: obscura/cone.h says what they are.

// cos(alpha) of the cap whose mean unoccluded direction N_ss has this length.
LEAF(Real) cap_cosine(Real mean_length) {
  Real c = leaf_max(leaf_fms(real(2.0f), mean_length, real(1.0f)), real(0.0f));
  return leaf_min(c, real(1.0f));
}

// The cone's half-angle from |N_ss|; `paper`: Klehm et al. 2011, section 3.2, (1 - c) pi/2.
LEAF(Real) cone_half_angle(bool paper, Real mean_length) {
  Real c = cap_cosine(mean_length);
  return paper ? (real(1.0f) - c) * real(1.57079632679f) : fast_acos(c);
}

// cos(alpha) of the cap whose cosine-weighted mean direction has this length m: the inverse of
// m = 2/3 (1 + c + c^2) / (1 + c), which is c^2 + k c + k = 0.
LEAF(Real) cap_cosine_of_cosine_mean(Real mean_length) {
  Real m = leaf_min(mean_length, real(1.0f));
  Real k = leaf_min(leaf_nfma(real(1.5f), m, real(1.0f)), real(0.0f));
  Real root = leaf_sqrt(k * (k - real(4.0f)));
  return leaf_min(real(0.5f) * (root - k), real(1.0f));
}

// Where the uniform integral is no longer than this, or twice the uniform visibility no more, next
// to nothing is open, and the direction is noise.
const float kLeastOpen = 1e-3f;

// |N_ss| = |N| / (2 AO); 1, as of the narrowest opening, where no direction is open.
LEAF(Real) mean_direction_length(Real length, Real twice_ambient) {
  Real mean = length * leaf_reciprocal(leaf_max(twice_ambient, real(1e-30f)));
  return leaf_select(leaf_less(real(0.0f), twice_ambient), mean, real(1.0f));
}

// The open share from the cosine-weighted visibility and n.(mean V w - open n/2), for
// n.(1/pi integral of V w) = open + 2 n.(x, y, z) is the former.
LEAF(Real) uniform_open(Real cosine_visible, Real along_normal) {
  return leaf_max(leaf_nfma(real(2.0f), along_normal, cosine_visible), real(0.0f));
}

struct BentCone {
  Real x, y, z;  // unit direction
  Real angle;    // radians
};

// Bent normal and cone of the uniform integral N = (x, y, z) and twice the uniform visibility. A
// closed point, no direction of which is open, has its normal and the angle 0.
LEAF(BentCone)
bent_cone(bool paper, Real x, Real y, Real z, Real twice_ambient, Real nx, Real ny, Real nz) {
  Real square = leaf_fma(x, x, leaf_fma(y, y, z * z));
  Truth open = leaf_both(leaf_less(real(kLeastOpen * kLeastOpen), square),
                         leaf_less(real(kLeastOpen), twice_ambient));
  Real scale = leaf_inverse_sqrt(leaf_max(square, real(1e-30f)));
  BentCone cone;
  cone.x = leaf_select(open, x * scale, nx);
  cone.y = leaf_select(open, y * scale, ny);
  cone.z = leaf_select(open, z * scale, nz);
  Real mean = mean_direction_length(square * scale, twice_ambient);
  cone.angle = leaf_where(open, cone_half_angle(paper, mean));
  return cone;
}
