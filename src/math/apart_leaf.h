// Leaf functions, C++ and GLSL: see math/leaf-inl.h. No include guard, for it is included once per
// SIMD target.

// A surface more than this many times as deep as another does not go on from it: no mean is taken
// of both, which would lie where nothing is. So the depth of what is far behind, such as a
// backdrop, does not count, however large it is: beside what is near it is background.
const float kApart = 4.0f;
LEAF(Truth) lies_beside(Real nearer, Real deeper) {
  return leaf_less_equal(deeper, real(kApart) * nearer);
}
