// Integrals along lines through the unit sphere over Highway lanes (math/sphere_line.h); included
// once per SIMD target.
#if defined(OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_
#undef OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_
#else
#define OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_
#endif

#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// As math::quadratic_line, for lateral >= 1e-6; asinh by the logarithm of |z|, for it is odd.
template <class D, class V>
HWY_INLINE V QuadraticLine(D d, V z, V lateral) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0f), square = hn::Mul(lateral, lateral);
  const V a = hn::Abs(z), a2 = hn::Mul(a, a);
  const V s = hn::Sqrt(hn::Add(square, a2));
  const V asinh = hn::Log(d, hn::Div(hn::Add(a, s), lateral));
  const V polynomial = hn::MulAdd(a2, hn::Set(d, 1.0f / 3), hn::Sub(hn::Add(one, square), s));
  return hn::CopySign(hn::NegMulAdd(square, asinh, hn::Mul(a, polynomial)), z);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
