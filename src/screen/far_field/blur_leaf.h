// Leaf functions, C++ and GLSL: see math/leaf-inl.h. The blur after jitter (Timonen 2013, sections
// 10 and 11.1).
const float kDepthRatio = 0.03f;
const int kBlurReach = 2;
const float kBlurThreshold = 0.07f * 3.14159265f;  // of obscurance: 7 % of visibility

// Nothing is like the background: from it every surface would be within any share of its depth.
LEAF(Truth) same_depth(Real own, Real other) {
  return leaf_both(leaf_less(own, leaf_inf()),
                   leaf_less_equal(leaf_abs(other - own), real(kDepthRatio) * own));
}

// 1 2 3 2 1, which give each pixel of a 3x3 pattern the same.
LEAF(Real) blur_weight(int distance_x, int distance_y) {
  return real(float((kBlurReach + 1 - distance_x) * (kBlurReach + 1 - distance_y)));
}
LEAF(Truth) blurs(Real own, Real other, Real own_depth, Real other_depth) {
  return leaf_both(same_depth(own_depth, other_depth),
                   leaf_less_equal(leaf_abs(other - own), real(kBlurThreshold)));
}
