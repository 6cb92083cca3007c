// The words of leaf files (math/*_leaf.h) over Highway lanes; included once per SIMD target, in the
// namespace HWY_NAMESPACE. A leaf file holds formulas once for all: the same text is read here,
// over plain floats (math/leaf_scalar.h) and in GLSL (math/leaf_glsl.h), with a dozen words that
// each of them defines. What the shader has as a specialization constant is a parameter of the
// class that includes the leaf file in C++. A branch asks `leaf_any`, whether a lane needs it, and
// selects.
#if defined(OBSCURA_SRC_MATH_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_LEAF_INL_H_
#undef OBSCURA_SRC_MATH_LEAF_INL_H_
#else
#define OBSCURA_SRC_MATH_LEAF_INL_H_
#endif

#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "math/fast-inl.h"
#include "math/leaf_cpp.h"
#include "math/spread_bits.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using Real = hn::Vec<D>;
using Truth = hn::Mask<D>;
using Int = hn::Vec<DI>;
using Bits = hn::Vec<DU>;

LEAF(Real) real(float x) { return hn::Set(D(), x); }
LEAF(Real) leaf_inf() { return hn::Inf(D()); }
LEAF(Real) leaf_neg(Real x) { return hn::Neg(x); }
LEAF(Real) leaf_abs(Real x) { return hn::Abs(x); }
LEAF(Real) leaf_sqrt(Real x) { return hn::Sqrt(x); }
LEAF(Real) leaf_inverse_sqrt(Real x) { return FastInverseSqrt(D(), x); }
// To the last bits but one; x is normal.
LEAF(Real) leaf_reciprocal(Real x) { return FastReciprocal(D(), x); }
LEAF(Real) leaf_log(Real x) { return hn::Log(D(), x); }
LEAF(Real) leaf_floor(Real x) { return hn::Floor(x); }
LEAF(Real) leaf_fma(Real a, Real b, Real c) { return hn::MulAdd(a, b, c); }
LEAF(Real) leaf_nfma(Real a, Real b, Real c) { return hn::NegMulAdd(a, b, c); }
LEAF(Real) leaf_fms(Real a, Real b, Real c) { return hn::MulSub(a, b, c); }
LEAF(Real) leaf_min(Real a, Real b) { return hn::Min(a, b); }
LEAF(Real) leaf_max(Real a, Real b) { return hn::Max(a, b); }
LEAF(Real) leaf_copysign(Real magnitude, Real z) { return hn::CopySign(magnitude, z); }
LEAF(Real) leaf_if_less(Real a, Real b, Real yes, Real no) {
  return hn::IfThenElse(hn::Lt(a, b), yes, no);
}
LEAF(Real) leaf_if_negative(Real x, Real yes, Real no) {
  return hn::IfThenElse(hn::Lt(x, hn::Zero(D())), yes, no);
}
// Of |x| <= pi/2.
LEAF(void) leaf_sin_cos(Real x, Real& sine, Real& cosine) { FastSinCos(D(), x, sine, cosine); }

LEAF(Truth) leaf_truth(bool t) {
  const Real zero = hn::Zero(D());
  return t ? hn::Ge(zero, zero) : hn::Lt(zero, zero);
}
LEAF(Truth) leaf_less(Real a, Real b) { return hn::Lt(a, b); }
LEAF(Truth) leaf_less_equal(Real a, Real b) { return hn::Le(a, b); }
LEAF(Truth) leaf_both(Truth a, Truth b) { return hn::And(a, b); }
LEAF(Truth) leaf_either(Truth a, Truth b) { return hn::Or(a, b); }
LEAF(Truth) leaf_differ(Truth a, Truth b) { return hn::Xor(a, b); }
LEAF(Truth) leaf_not(Truth t) { return hn::Not(t); }
LEAF(bool) leaf_any(Truth t) { return !hn::AllFalse(D(), t); }
LEAF(Real) leaf_select(Truth t, Real yes, Real no) { return hn::IfThenElse(t, yes, no); }
LEAF(Real) leaf_where(Truth t, Real yes) { return hn::IfThenElseZero(t, yes); }

LEAF(Int) leaf_whole(int i) { return hn::Set(DI(), i); }
LEAF(Int) leaf_int(Real x) { return hn::ConvertTo(DI(), x); }
LEAF(Real) leaf_from_int(Int i) { return hn::ConvertTo(D(), i); }
LEAF(Int) leaf_bits_of(Real x) { return hn::BitCast(DI(), x); }
LEAF(Int) leaf_shift_right(Int i, int bits) { return hn::ShiftRightSame(i, bits); }
LEAF(Int) leaf_and(Int a, Int b) { return hn::And(a, b); }

// Sets of 32 bits.
LEAF(Bits) leaf_no_bits() { return hn::Zero(DU()); }
LEAF(Bits) leaf_except(Bits a, Bits b) { return hn::AndNot(b, a); }
LEAF(Bits) leaf_all_bits() { return hn::Set(DU(), 0xFFFFFFFFu); }
LEAF(Bits) leaf_intersection(Bits a, Bits b) { return hn::And(a, b); }
LEAF(Bits) leaf_union(Bits a, Bits b) { return hn::Or(a, b); }
LEAF(Bits) leaf_bits_where(Truth t, Bits bits) {
  return hn::IfThenElseZero(hn::RebindMask(DU(), t), bits);
}
LEAF(bool) leaf_any_bit(Bits bits) { return !hn::AllTrue(DU(), hn::Eq(bits, hn::Zero(DU()))); }
LEAF(Real) leaf_count_bits(Bits bits) {
  return hn::ConvertTo(D(), hn::BitCast(DI(), hn::PopulationCount(bits)));
}
// The lowest `place` bits, rounded. A shift by 32 would be undefined.
LEAF(Bits) leaf_bits_below(Real place) {
  const DI di;
  const DU du;
  const Int n = hn::Min(hn::Max(hn::NearestInt(place), hn::Zero(di)), hn::Set(di, 32));
  const Bits all = hn::Set(du, 0xFFFFFFFFu);
  const Bits shifted = hn::Shl(all, hn::BitCast(du, hn::Min(n, hn::Set(di, 31))));
  const Int below = hn::IfThenElse(hn::Eq(n, hn::Set(di, 32)), hn::BitCast(di, all),
                                   hn::BitCast(di, hn::Not(shifted)));
  return hn::BitCast(du, below);
}

// `count` of 32 bits, rounded, spread evenly; another `turn` gives others.
LEAF(Bits) leaf_spread_bits(Real count, int turn) {
  const DI di;
  const Int n = hn::Min(hn::Max(hn::NearestInt(count), hn::Zero(di)), hn::Set(di, 32));
  HWY_ALIGN std::int32_t at[HWY_MAX_BYTES / 4];
  HWY_ALIGN std::uint32_t bits[HWY_MAX_BYTES / 4];
  hn::Store(n, di, at);
  for (std::size_t i = 0; i < hn::Lanes(di); ++i)
    bits[i] = std::rotl(kSpreadBits[at[i]], 13 * turn);
  return hn::Load(DU(), bits);
}

#include "math/slab_leaf.h"
// After slab_leaf.h.
#include "math/azimuth_leaf.h"
#include "math/sphere_line_leaf.h"

}  // namespace leaf
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
