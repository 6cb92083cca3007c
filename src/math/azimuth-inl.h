// The frame of an azimuthal slice around a receiver, over Highway lanes; included once per SIMD
// target. Coordinates: u to the right, v down, w along the view; the receiver's ray is (a, b, 1) at
// depth 1, its zenith -ray/|ray|.
#if defined(OBSCURA_SRC_MATH_AZIMUTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_AZIMUTH_INL_H_
#undef OBSCURA_SRC_MATH_AZIMUTH_INL_H_
#else
#define OBSCURA_SRC_MATH_AZIMUTH_INL_H_
#endif

#include <cmath>

#include "hwy/highway.h"
#include "math/fast-inl.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// An image direction at depth 1: pixels times the size of a pixel.
struct ImageStep {
  float u, v;
};

template <class V>
struct Ray {
  V a, b, length, inverse_length;
};
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE Ray<V> MakeRay(D d, V a, V b) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0f);
  const V length = hn::Sqrt(hn::MulAdd(a, a, hn::MulAdd(b, b, one)));
  return {a, b, length, hn::Div(one, length)};
}

template <class V>
struct Azimuth {
  V along_ray, lateral;  // the step's parts along the ray and at right angles to it (the tangent)
  V nz, nt;              // the normal along zenith and tangent
};
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V AlongRay(D d, const Ray<V>& r, ImageStep e) {
  namespace hn = hwy::HWY_NAMESPACE;
  return leaf::part_along_ray(r.a, r.b, r.inverse_length, hn::Set(d, e.u), hn::Set(d, e.v));
}
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE Azimuth<V> MakeAzimuth(D d, const Ray<V>& r, ImageStep step, V nu, V nv, V nw) {
  namespace hn = hwy::HWY_NAMESPACE;
  Azimuth<V> s;
  s.along_ray = AlongRay(d, r, step);
  const V square = hn::Set(d, step.u * step.u + step.v * step.v);
  s.lateral = leaf::part_across_ray(s.along_ray, square);
  s.nz = hn::Neg(hn::Mul(hn::MulAdd(nu, r.a, hn::MulAdd(nv, r.b, nw)), r.inverse_length));
  const V along = hn::MulAdd(nu, hn::Set(d, step.u), hn::Mul(nv, hn::Set(d, step.v)));
  s.nt = hn::Div(hn::MulAdd(s.nz, s.along_ray, along), s.lateral);
  return s;
}

// The angle around the zenith between two image directions: w_k of equation 2.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V AzimuthBetween(D d, const Ray<V>& r, ImageStep low, ImageStep high) {
  namespace hn = hwy::HWY_NAMESPACE;
  const float area = std::abs(low.u * high.v - low.v * high.u);
  const float product = low.u * high.u + low.v * high.v;
  return leaf::angle_around_ray(r.inverse_length, AlongRay(d, r, low), AlongRay(d, r, high),
                                hn::Set(d, area), hn::Set(d, product));
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
