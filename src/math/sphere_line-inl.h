// Integrals along lines through the unit sphere over Highway lanes (math/sphere_line.h); included
// once per SIMD target.
#if defined(OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_
#undef OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_
#else
#define OBSCURA_SRC_MATH_SPHERE_LINE_INL_H_
#endif

#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// As math::quadratic_line, for lateral >= 1e-6.
template <class D, class V>
HWY_INLINE V QuadraticLine(D, V z, V lateral) {
  return leaf::quadratic_line(z, lateral);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
