// The words of leaf functions (math/*_leaf.h) over Highway lanes; included once per SIMD target, in
// the namespace HWY_NAMESPACE. A leaf file is plain arithmetic without branches, so that the same
// text is C++ here and GLSL in shaders (math/leaf_glsl.h).
#if defined(OBSCURA_SRC_MATH_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_LEAF_INL_H_
#undef OBSCURA_SRC_MATH_LEAF_INL_H_
#else
#define OBSCURA_SRC_MATH_LEAF_INL_H_
#endif

#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "math/fast-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using Real = hn::Vec<D>;

HWY_INLINE Real real(float x) { return hn::Set(D(), x); }
HWY_INLINE Real leaf_neg(Real x) { return hn::Neg(x); }
HWY_INLINE Real leaf_abs(Real x) { return hn::Abs(x); }
HWY_INLINE Real leaf_sqrt(Real x) { return hn::Sqrt(x); }
HWY_INLINE Real leaf_inverse_sqrt(Real x) { return FastInverseSqrt(D(), x); }
// To the last bits but one; x is normal.
HWY_INLINE Real leaf_reciprocal(Real x) { return FastReciprocal(D(), x); }
HWY_INLINE Real leaf_log(Real x) { return hn::Log(D(), x); }
HWY_INLINE Real leaf_fma(Real a, Real b, Real c) { return hn::MulAdd(a, b, c); }
HWY_INLINE Real leaf_nfma(Real a, Real b, Real c) { return hn::NegMulAdd(a, b, c); }
HWY_INLINE Real leaf_min(Real a, Real b) { return hn::Min(a, b); }
HWY_INLINE Real leaf_max(Real a, Real b) { return hn::Max(a, b); }
HWY_INLINE Real leaf_if_less(Real a, Real b, Real yes, Real no) {
  return hn::IfThenElse(hn::Lt(a, b), yes, no);
}
HWY_INLINE Real leaf_if_negative(Real x, Real yes, Real no) {
  return hn::IfThenElse(hn::Lt(x, hn::Zero(D())), yes, no);
}
HWY_INLINE Real leaf_copysign(Real magnitude, Real z) { return hn::CopySign(magnitude, z); }

#define LEAF(type) HWY_INLINE type
#include "math/slab_leaf.h"
// After slab_leaf.h.
#include "math/azimuth_leaf.h"
#include "math/sphere_line_leaf.h"
#undef LEAF

}  // namespace leaf
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
