// Angles over Highway lanes by short polynomials; included once per SIMD target.
#if defined(OBSCURA_SRC_MATH_ANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_ANGLE_INL_H_
#undef OBSCURA_SRC_MATH_ANGLE_INL_H_
#else
#define OBSCURA_SRC_MATH_ANGLE_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// acos(x) for |x| <= 1, absolute error under 4e-7: sqrt(1 - |x|) times the polynomial of Abramowitz
// and Stegun 4.4.46, mirrored for x < 0.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V FastAcos(D d, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V a = hn::Min(hn::Abs(x), hn::Set(d, 1.0f));
  V p = hn::Set(d, -0.0012624911f);
  p = hn::MulAdd(p, a, hn::Set(d, 0.0066700901f));
  p = hn::MulAdd(p, a, hn::Set(d, -0.0170881256f));
  p = hn::MulAdd(p, a, hn::Set(d, 0.0308918810f));
  p = hn::MulAdd(p, a, hn::Set(d, -0.0501743046f));
  p = hn::MulAdd(p, a, hn::Set(d, 0.0889789874f));
  p = hn::MulAdd(p, a, hn::Set(d, -0.2145988016f));
  p = hn::MulAdd(p, a, hn::Set(d, 1.5707963050f));
  const V r = hn::Mul(p, hn::Sqrt(hn::Sub(hn::Set(d, 1.0f), a)));
  return hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(hn::Set(d, 3.14159265f), r), r);
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
