// The words of leaf functions (math/*_leaf.h) in GLSL. math/leaf-inl.h says the same in C++.
#define Real float
#define LEAF(type) type
#define real(x) (x)
#define leaf_neg(x) (-(x))
#define leaf_abs abs
#define leaf_sqrt sqrt
#define leaf_inverse_sqrt inversesqrt
#define leaf_reciprocal(x) (1.0 / (x))
#define leaf_log log
#define leaf_fma fma
#define leaf_nfma(a, b, c) fma(-(a), b, c)
#define leaf_min min
#define leaf_max max
#define leaf_if_less(a, b, yes, no) ((a) < (b) ? (yes) : (no))
#define leaf_if_negative(x, yes, no) ((x) < 0.0 ? (yes) : (no))
#define leaf_copysign(magnitude, z) ((z) < 0.0 ? -(magnitude) : (magnitude))
