// Fast elementary functions over Highway lanes; included once per SIMD target. Their last bits
// differ between targets, as the estimates that they refine do.
#if defined(OBSCURA_SRC_MATH_FAST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_FAST_INL_H_
#undef OBSCURA_SRC_MATH_FAST_INL_H_
#else
#define OBSCURA_SRC_MATH_FAST_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// Newton steps that an estimate needs: x86 estimates have 12 bits, those of NEON 8.
constexpr int kNewtonSteps = HWY_TARGET == HWY_NEON ? 2 : 1;

// 1 / x for |x| in [1e-37, 1e37], relative error under 3e-7: an estimate and Newton steps.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V FastReciprocal(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  V r = hn::ApproximateReciprocal(x);
  for (int i = 0; i < kNewtonSteps; ++i) r = hn::Mul(r, hn::NegMulAdd(x, r, hn::Set(d, 2.0f)));
  return r;
}

// 1 / sqrt(x) for x in [1e-37, 1e37], relative error under 5e-7: an estimate and Newton steps.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V FastInverseSqrt(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  V r = hn::ApproximateReciprocalSqrt(x);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const V half = hn::Mul(hn::Set(d, 0.5f), hn::Mul(x, r));
    r = hn::Mul(r, hn::NegMulAdd(half, r, hn::Set(d, 1.5f)));
  }
  return r;
}

// exp(-x) for x >= 0, absolute error under 4e-6 (2^t by its whole and fractional part); 0 from 80
// on.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V FastExpNegative(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const V t = hn::Mul(hn::Min(x, hn::Set(d, 85.0f)), hn::Set(d, -1.44269504f));
  // Adding 1.5 * 2^23 leaves the whole part in the low bits.
  const V shifted = hn::Add(t, hn::Set(d, 12582912.0f));
  const V f = hn::Sub(t, hn::Sub(shifted, hn::Set(d, 12582912.0f)));
  V p = hn::MulAdd(f, hn::Set(d, 0.00961813f), hn::Set(d, 0.05550411f));
  p = hn::MulAdd(f, p, hn::Set(d, 0.24022651f));
  p = hn::MulAdd(f, p, hn::Set(d, 0.69314718f));
  p = hn::MulAdd(f, p, hn::Set(d, 1.0f));
  const auto exponent = hn::ShiftLeft<23>(hn::BitCast(di, shifted));
  return hn::BitCast(d, hn::Add(hn::BitCast(di, p), exponent));
}

// Sine and cosine of |x| <= pi/2 by Taylor polynomials; absolute error under 4e-6.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE void FastSinCos(D d, V x, V& sine, V& cosine) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V s = hn::Mul(x, x), one = hn::Set(d, 1.0f);
  V p = hn::MulAdd(s, hn::Set(d, 1.0f / 362880), hn::Set(d, -1.0f / 5040));
  p = hn::MulAdd(s, p, hn::Set(d, 1.0f / 120));
  p = hn::MulAdd(s, p, hn::Set(d, -1.0f / 6));
  sine = hn::Mul(x, hn::MulAdd(s, p, one));
  p = hn::MulAdd(s, hn::Set(d, -1.0f / 3628800), hn::Set(d, 1.0f / 40320));
  p = hn::MulAdd(s, p, hn::Set(d, -1.0f / 720));
  p = hn::MulAdd(s, p, hn::Set(d, 1.0f / 24));
  p = hn::MulAdd(s, p, hn::Set(d, -0.5f));
  cosine = hn::MulAdd(s, p, one);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
