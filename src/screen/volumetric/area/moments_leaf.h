// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target.

const float kMomentWeights[5] =
    LEAF_LIST(1.0f / 16.0f, 4.0f / 16.0f, 6.0f / 16.0f, 4.0f / 16.0f, 1.0f / 16.0f);

// Five pixels as one by the law of total variance; w are their shares of surface times weights.

// Of their means m, relative to the middle one's, which is near the result, so that little is
// rounded.
LEAF(Real) merged_mean(Real w[5], Real m[5], Real per_sum) {
  Real first = real(0.0f);
  for (int k = 0; k < 5; ++k) first = leaf_fma(w[k], m[k] - m[2], first);
  return leaf_fma(first, per_sum, m[2]);
}

// The variance times the sum of w. Differences are bounded so that squares stay finite.
LEAF(Real) merged_variance(Real w[5], Real m[5], Real variance[5], Real average) {
  Real second = real(0.0f);
  for (int k = 0; k < 5; ++k) {
    Real off = leaf_max(leaf_min(m[k] - average, real(1e18f)), real(-1e18f));
    second = leaf_fma(w[k], leaf_fma(off, off, variance[k]), second);
  }
  return second;
}
