// Bent cones over Highway lanes, as obscura/cone.h over floats; included once per SIMD target.
#if defined(OBSCURA_SRC_MATH_CONE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_CONE_INL_H_
#undef OBSCURA_SRC_MATH_CONE_INL_H_
#else
#define OBSCURA_SRC_MATH_CONE_INL_H_
#endif

#include "hwy/highway.h"
#include "math/fast-inl.h"
#include "math/leaf-inl.h"
#include "obscura/cone.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// What an estimator has summed over the directions of a pixel.
template <class V>
struct DirectionSums {
  V x, y, z;  // sum of V w, w unit
  V open;     // sum of V
};

template <class V>
struct BentCone {
  V x, y, z;  // unit direction
  V angle;    // radians
};

// The cone's half-angle from |N_ss|.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V ConeAngle(D d, bool paper, V mean_length) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0f);
  const V c = hn::Min(hn::Max(hn::MulSub(hn::Set(d, 2.0f), mean_length, one), hn::Zero(d)), one);
  return paper ? hn::Mul(hn::Sub(one, c), hn::Set(d, 1.57079632679f)) : leaf::fast_acos(c);
}

// Bent normal and cone from sums with uniform weights. Where nothing is visible, or the visible
// directions cancel, the direction is the normal (nx, ny, nz), unit; an open cone goes with it.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE BentCone<V> FinishCone(D d, bool paper, const DirectionSums<V>& s, V nx, V ny, V nz) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V square = hn::MulAdd(s.x, s.x, hn::MulAdd(s.y, s.y, hn::Mul(s.z, s.z)));
  // Lengths under a millionth of the sum are rounding.
  const V least = hn::Mul(s.open, hn::Set(d, 1e-6f));
  const auto known = hn::And(hn::Gt(square, hn::Mul(least, least)), hn::Gt(s.open, hn::Zero(d)));
  const V tiny = hn::Set(d, 1e-37f);
  const V scale = FastInverseSqrt(d, hn::Max(square, tiny));
  const V mean = hn::IfThenElseZero(
      known, hn::Mul(hn::Mul(square, scale), FastReciprocal(d, hn::Max(s.open, tiny))));
  return {hn::IfThenElse(known, hn::Mul(s.x, scale), nx),
          hn::IfThenElse(known, hn::Mul(s.y, scale), ny),
          hn::IfThenElse(known, hn::Mul(s.z, scale), nz), ConeAngle(d, paper, mean)};
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
