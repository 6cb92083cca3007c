// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/apart_leaf.h. No include guard, for
// it is included once per SIMD target.

const float kMomentWeights[5] =
    LEAF_LIST(1.0f / 16.0f, 4.0f / 16.0f, 6.0f / 16.0f, 4.0f / 16.0f, 1.0f / 16.0f);

// The least of five means that have a weight w, plus `slack`, and the mean and weight of one beside
// it: what lies apart is background there, and its mean must not spoil the others' bits.
LEAF(Real) nearest_mean(Real w[5], Real m[5], Real slack) {
  Real nearest = leaf_inf();
  for (int k = 0; k < 5; ++k) {
    nearest = leaf_select(leaf_less(real(0.0f), w[k]), leaf_min(nearest, m[k]), nearest);
  }
  return nearest + slack;
}
LEAF(Real) mean_beside(Real nearest, Real m) {
  return leaf_select(lies_beside(nearest, m), m, nearest);
}
LEAF(Real) weight_beside(Real nearest, Real w, Real m) {
  return leaf_where(lies_beside(nearest, m), w);
}

// Whether a level's own moments count beside those of the next one, whose kernel holds its kernel.
LEAF(Truth) stands_beside(Real share, Real mean, Real next_mean, Real slack) {
  return leaf_both(leaf_less(real(0.0f), share), lies_beside(next_mean + slack, mean));
}

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
