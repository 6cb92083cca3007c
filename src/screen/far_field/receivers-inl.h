// Receivers of a row and the slice of one segment around each; included once per SIMD target.
#if defined(OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#undef OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#else
#define OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#endif

#include "hwy/highway.h"
#include "math/azimuth-inl.h"
#include "math/fast-inl.h"
#include "math/slab-inl.h"
#include "screen/far_field/slices.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace om = obscura::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// What is the same for all receivers of a row.
struct RowFrame {
  explicit RowFrame(const SliceRow& job)
      : plane(*job.plane),
        normals_row(job.row),
        v(job.row + plane.top),
        v_axis(static_cast<float>(v) - plane.center_v) {
    const float sign = static_cast<float>(job.sign);
    auto step = [&](float slope) {
      return om::ImageStep{slope * plane.scale_u, sign * plane.scale_v};
    };
    middle = step(job.segment->middle);
    low = step(job.segment->low);
    high = step(job.segment->high);
    axis = -sign * v_axis;
  }

  HWY_INLINE V DepthOf(V g) const {
    const D d;
    return plane.orthographic ? hn::Sub(hn::Set(d, plane.kappa), g) : om::FastReciprocal(d, g);
  }

  const Plane& plane;
  int normals_row, v;
  float v_axis;                     // rows from the camera's axis
  float axis;                       // the axis, in rows outwards from the receiver
  om::ImageStep middle, low, high;  // one row outwards
};

// A vector of receivers. A point whose major coordinate is `rows` outwards (in perspective: times
// its depth) on the segment's middle line lies at p - receiver = (depth' - depth) (a, b, 1) +
// rows middle; the slice's frame is the zenith -ray/|ray| and, as tangent, the part of `middle` at
// right angles to it.
struct Receivers {
  V depth, ray, back, lateral, camera;
  V width;  // w_k: the angle around the zenith between the segment's edges
  om::Slice<V> slice;
  M surface;

  HWY_INLINE V X(V rows) const { return hn::Abs(hn::Mul(rows, lateral)); }
  HWY_INLINE V Y(V point_depth, V rows) const {
    return hn::NegMulAdd(rows, back, hn::Mul(ray, hn::Sub(depth, point_depth)));
  }
};

// The receivers from visible column x on.
HWY_INLINE Receivers MakeReceivers(const RowFrame& f, int x) {
  const D d;
  const Plane& p = f.plane;
  const V one = hn::Set(d, 1.0f);
  const V perspective = hn::Set(d, p.orthographic ? 0.0f : 1.0f);
  Receivers r;
  const int u = x + p.left;
  const V g = hn::LoadU(d, p.lattice.row(f.v) + u);
  r.surface = hn::Gt(g, hn::Zero(d));
  r.depth = f.DepthOf(hn::IfThenElse(r.surface, g, one));

  const V u_axis = hn::Add(hn::Iota(d, static_cast<float>(u)), hn::Set(d, -p.center_u));
  const V a = hn::Mul(perspective, hn::Mul(u_axis, hn::Set(d, p.scale_u)));
  const V b = hn::Mul(perspective, hn::Set(d, f.v_axis * p.scale_v));
  const om::Ray<V> ray = om::MakeRay(d, a, b);
  const om::Azimuth<V> azimuth =
      om::MakeAzimuth(d, ray, f.middle, hn::LoadU(d, p.normal_u.row(f.normals_row) + x),
                      hn::LoadU(d, p.normal_v.row(f.normals_row) + x),
                      hn::LoadU(d, p.normal_w.row(f.normals_row) + x));
  r.ray = ray.length;
  r.back = azimuth.along_ray;
  r.lateral = azimuth.lateral;
  r.camera = p.orthographic ? one : hn::Mul(r.depth, r.ray);
  r.slice = om::MakeSlice(d, azimuth.nz, azimuth.nt, r.camera, perspective);
  r.width = om::AzimuthBetween(d, ray, f.low, f.high);
  return r;
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#endif  // include guard
