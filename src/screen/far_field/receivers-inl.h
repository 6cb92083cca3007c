// Receivers of a row and the slice of one segment around each; included once per SIMD target.
#if defined(OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#undef OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#else
#define OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#endif

#include <cmath>

#include "hwy/highway.h"
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
  // e = (slope scale_u, sign scale_v, 0): one row outwards at depth 1, against the ray (a, b, 1).
  struct Step {
    float u, v;
  };

  explicit RowFrame(const SliceRow& job)
      : plane(*job.plane),
        normals_row(job.row),
        v(job.row + plane.top),
        v_axis(static_cast<float>(v) - plane.center_v) {
    const float sign = static_cast<float>(job.sign);
    auto step = [&](float slope) { return Step{slope * plane.scale_u, sign * plane.scale_v}; };
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
  float v_axis;  // rows from the camera's axis
  float axis;    // the axis, in rows outwards from the receiver
  Step middle, low, high;
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
  const V one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-30f);
  const V perspective = hn::Set(d, p.orthographic ? 0.0f : 1.0f);
  Receivers r;
  const int u = x + p.left;
  const V g = hn::LoadU(d, p.lattice.row(f.v) + u);
  r.surface = hn::Gt(g, hn::Zero(d));
  r.depth = f.DepthOf(hn::IfThenElse(r.surface, g, one));

  const V u_axis = hn::Add(hn::Iota(d, static_cast<float>(u)), hn::Set(d, -p.center_u));
  const V a = hn::Mul(perspective, hn::Mul(u_axis, hn::Set(d, p.scale_u)));
  const V b = hn::Mul(perspective, hn::Set(d, f.v_axis * p.scale_v));
  r.ray = hn::Sqrt(hn::MulAdd(a, a, hn::MulAdd(b, b, one)));
  const V inverse_ray = hn::Div(one, r.ray);
  auto along_ray = [&](RowFrame::Step e) HWY_ATTR {
    return hn::Mul(hn::MulAdd(hn::Set(d, e.u), a, hn::Mul(hn::Set(d, e.v), b)), inverse_ray);
  };
  r.back = along_ray(f.middle);
  const V step_square = hn::Set(d, f.middle.u * f.middle.u + f.middle.v * f.middle.v);
  r.lateral = hn::Sqrt(hn::Max(hn::NegMulAdd(r.back, r.back, step_square), tiny));
  const V nu = hn::LoadU(d, p.normal_u.row(f.normals_row) + x);
  const V nv = hn::LoadU(d, p.normal_v.row(f.normals_row) + x);
  const V nw = hn::LoadU(d, p.normal_w.row(f.normals_row) + x);
  const V nz = hn::Neg(hn::Mul(hn::MulAdd(nu, a, hn::MulAdd(nv, b, nw)), inverse_ray));
  const V along = hn::MulAdd(nu, hn::Set(d, f.middle.u), hn::Mul(nv, hn::Set(d, f.middle.v)));
  const V nt = hn::Div(hn::MulAdd(nz, r.back, along), r.lateral);
  r.camera = p.orthographic ? one : hn::Mul(r.depth, r.ray);
  r.slice = om::MakeSlice(d, nz, nt, r.camera, perspective);

  const float area = std::abs(f.low.u * f.high.v - f.low.v * f.high.u);
  const float flat = f.low.u * f.high.u + f.low.v * f.high.v;
  const V cross = hn::Mul(inverse_ray, hn::Set(d, area));
  const V dot = hn::NegMulAdd(along_ray(f.low), along_ray(f.high), hn::Set(d, flat));
  const V length = hn::Sqrt(hn::Max(hn::MulAdd(dot, dot, hn::Mul(cross, cross)), tiny));
  r.width = om::FastAcos(d, hn::Div(dot, length));
  return r;
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#endif  // include guard
