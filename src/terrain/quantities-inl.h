// What a horizon leaves of the sky, over Highway lanes; included once per SIMD target. The sources
// of the formulas stand in obscura/terrain.h.
#if defined(OBSCURA_SRC_TERRAIN_QUANTITIES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_TERRAIN_QUANTITIES_INL_H_
#undef OBSCURA_SRC_TERRAIN_QUANTITIES_INL_H_
#else
#define OBSCURA_SRC_TERRAIN_QUANTITIES_INL_H_
#endif

#include "hwy/highway.h"
#include "math/fast-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// The angle of a slope, in radians; absolute error under 3e-6 (a minimax polynomial in [0, 1]).
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V FastAtan(D d, V slope) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V size = hn::Abs(slope), one = hn::Set(d, 1.0f);
  const auto steep = hn::Gt(size, one);
  const V x = hn::IfThenElse(steep, FastReciprocal(d, hn::Max(size, one)), size);
  const V s = hn::Mul(x, x);
  V p = hn::Set(d, -0.0117212f);
  for (const float c : {0.05265332f, -0.11643287f, 0.19354346f, -0.33262347f, 0.99997726f}) {
    p = hn::MulAdd(p, s, hn::Set(d, c));
  }
  p = hn::Mul(p, x);
  p = hn::IfThenElse(steep, hn::Sub(hn::Set(d, 1.57079633f), p), p);
  return hn::CopySign(p, slope);
}

// A horizon whose angle g has the tangent `slope` >= 0.
template <class D>
struct Horizon {
  using V = hwy::HWY_NAMESPACE::Vec<D>;

  HWY_INLINE Horizon(D tag, V tangent) : d(tag), slope(tangent) {
    namespace hn = hwy::HWY_NAMESPACE;
    inverse = FastInverseSqrt(d, hn::MulAdd(slope, slope, hn::Set(d, 1.0f)));
  }

  // 1 - sin g.
  HWY_INLINE V OpenSky() const {
    namespace hn = hwy::HWY_NAMESPACE;
    return hn::NegMulAdd(slope, inverse, hn::Set(d, 1.0f));
  }
  // cos^2 g.
  HWY_INLINE V OpenCosine() const { return hwy::HWY_NAMESPACE::Mul(inverse, inverse); }
  HWY_INLINE V Angle() const { return FastAtan(d, slope); }
  // cos b cos^2 g + sin b cos(phi - a) (pi/2 - g - sin g cos g) of ground that rises by `towards`
  // in the horizon's direction: sin b cos(phi - a) = -towards cos b, as the aspect a points down.
  HWY_INLINE V OpenOnSlope(V towards, V cosine) const {
    namespace hn = hwy::HWY_NAMESPACE;
    const V open = OpenCosine();
    const V segment = hn::NegMulAdd(slope, open, hn::Sub(hn::Set(d, 1.57079633f), Angle()));
    return hn::Mul(cosine, hn::NegMulAdd(towards, segment, open));
  }

  D d;
  V slope, inverse;
};

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
