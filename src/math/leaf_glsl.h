// The words of leaf files (math/*_leaf.h) in GLSL. math/leaf-inl.h says the same in C++.
#define Real float
#define Truth bool
#define Int int
#define Bits uint
#define LEAF(type) type
#define LEAF_IN(type) type
#define LEAF_INOUT(type) inout type
#define LEAF_LIST float[]
#define real(x) (x)
#define leaf_inf() uintBitsToFloat(0x7f800000u)
#define leaf_neg(x) (-(x))
#define leaf_abs abs
#define leaf_sqrt sqrt
#define leaf_inverse_sqrt inversesqrt
#define leaf_reciprocal(x) (1.0 / (x))
#define leaf_log log
#define leaf_floor floor
#define leaf_fma fma
#define leaf_nfma(a, b, c) fma(-(a), b, c)
#define leaf_fms(a, b, c) fma(a, b, -(c))
#define leaf_min min
#define leaf_max max
#define leaf_copysign(magnitude, z) ((z) < 0.0 ? -(magnitude) : (magnitude))
#define leaf_if_less(a, b, yes, no) ((a) < (b) ? (yes) : (no))
#define leaf_if_negative(x, yes, no) ((x) < 0.0 ? (yes) : (no))

#define leaf_truth(t) (t)
#define leaf_less(a, b) ((a) < (b))
#define leaf_less_equal(a, b) ((a) <= (b))
#define leaf_both(a, b) ((a) && (b))
#define leaf_either(a, b) ((a) || (b))
#define leaf_differ(a, b) ((a) != (b))
#define leaf_not(t) (!(t))
#define leaf_any(t) (t)
#define leaf_select(t, yes, no) ((t) ? (yes) : (no))
#define leaf_where(t, yes) ((t) ? (yes) : 0.0)

#define leaf_whole(i) (i)
#define leaf_int(x) int(x)
#define leaf_from_int(i) float(i)
#define leaf_bits_of(x) floatBitsToInt(x)
#define leaf_shift_right(i, bits) ((i) >> (bits))
#define leaf_and(a, b) ((a) & (b))

#define leaf_no_bits() 0u
#define leaf_except(a, b) ((a) & ~(b))
#define leaf_all_bits() 0xFFFFFFFFu
#define leaf_intersection(a, b) ((a) & (b))
#define leaf_union(a, b) ((a) | (b))
#define leaf_bits_where(t, bits) ((t) ? (bits) : 0u)
#define leaf_any_bit(bits) ((bits) != 0u)
#define leaf_count_bits(bits) float(bitCount(bits))

void leaf_sin_cos(float x, out float sine, out float cosine) {
  sine = sin(x);
  cosine = cos(x);
}
uint leaf_bits_below(float place) {
  const int n = clamp(int(roundEven(place)), 0, 32);
  return n == 32 ? 0xFFFFFFFFu : (1u << n) - 1u;
}
// math/spread_bits.h: bit j of a word where j, its five digits in reverse, is less than the count.
uint leaf_spread_bits(float count, int turn) {
  const uint n = uint(clamp(int(roundEven(count)), 0, 32));
  uint bits = 0u;
  for (uint j = 0u; j < n; ++j) bits |= 1u << (bitfieldReverse(j) >> 27);
  const int by = (13 * turn) & 31;
  return by == 0 ? bits : (bits << by) | (bits >> (32 - by));
}
