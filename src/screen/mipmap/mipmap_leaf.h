// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/apart_leaf.h. No include guard, for
// it is included once per SIMD target.

// Between four depths, two above two, at shares s and t; 0 where any is background (0) or they lie
// apart.
LEAF(Real) between_depths(Real a, Real b, Real c, Real e, Real s, Real t) {
  Real top = leaf_fma(s, b - a, a), bottom = leaf_fma(s, e - c, c);
  Real least = leaf_min(leaf_min(a, b), leaf_min(c, e));
  Real most = leaf_max(leaf_max(a, b), leaf_max(c, e));
  Truth together = leaf_both(leaf_less(real(0.0f), least), lies_beside(least, most));
  return leaf_where(together, leaf_fma(t, bottom - top, top));
}

// Between the depths of two levels, likewise.
LEAF(Real) between_levels(Real fine, Real coarse, Real blend) {
  Real least = leaf_min(fine, coarse), most = leaf_max(fine, coarse);
  Truth together = leaf_both(leaf_less(real(0.0f), least), lies_beside(least, most));
  return leaf_where(together, leaf_fma(blend, coarse - fine, fine));
}

// The place in the slice of a point at depth q, `t` pixels along a direction whose parts along the
// ray and across it are given; the receiver is at `depth`.
struct PyramidPoint {
  Real x, y;
};
LEAF(PyramidPoint)
pyramid_point(Real t, Real q, Real depth, Real ray_length, Real along, Real across, bool parallel) {
  Real pixels = parallel ? t : t * q;
  PyramidPoint p;
  p.x = pixels * across;
  p.y = leaf_nfma(pixels, along, ray_length * (depth - q));
  return p;
}

// A texel of a level from four of the level below: the mean or the least of the depths that are
// there, without those that lie apart from the least; 0, background, where none is.
LEAF(Real) depth_of_four(Real four[4], bool mean) {
  Real zero = real(0.0f);
  Real sum = zero, count = zero, nearest = leaf_inf();
  for (int i = 0; i < 4; ++i) {
    Truth there = leaf_less(zero, four[i]);
    nearest = leaf_min(nearest, leaf_select(there, four[i], leaf_inf()));
  }
  for (int i = 0; i < 4; ++i) {
    Truth counts = leaf_both(leaf_less(zero, four[i]), lies_beside(nearest, four[i]));
    sum = sum + leaf_where(counts, four[i]);
    count = count + leaf_where(counts, real(1.0f));
  }
  return leaf_where(leaf_less(zero, count), mean ? sum / count : nearest);
}
