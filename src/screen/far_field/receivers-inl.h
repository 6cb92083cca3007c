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
        receivers(*job.receivers),
        row(job.row),
        column(job.column),
        v_axis(static_cast<float>(job.row + plane.top) - plane.center_v) {
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
    return plane.orthographic ? hn::Sub(hn::Set(d, plane.ortho_offset), g)
                              : om::FastReciprocal(d, g);
  }

  const Plane& plane;
  const ReceiverImages& receivers;
  int row, column;
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

// Receivers from number i of the row's phase on.
HWY_INLINE Receivers MakeReceivers(const RowFrame& f, int i) {
  const D d;
  const Plane& p = f.plane;
  const V one = hn::Set(d, 1.0f);
  const V perspective = hn::Set(d, p.orthographic ? 0.0f : 1.0f);
  Receivers r;
  const V g = hn::LoadU(d, f.receivers.lattice.at(f.row, f.column) + i);
  r.surface = hn::Gt(g, hn::Zero(d));
  r.depth = f.DepthOf(hn::IfThenElse(r.surface, g, one));

  const int phases = p.lattice.phases();
  const float first = static_cast<float>(f.column + i * phases + p.left) - p.center_u;
  const V u_axis =
      hn::MulAdd(hn::Iota(d, 0), hn::Set(d, static_cast<float>(phases)), hn::Set(d, first));
  const V a = hn::Mul(perspective, hn::Mul(u_axis, hn::Set(d, p.scale_u)));
  const V b = hn::Mul(perspective, hn::Set(d, f.v_axis * p.scale_v));
  const om::Ray<V> ray = om::MakeRay(d, a, b);
  auto normal = [&](int axis) HWY_ATTR {
    return hn::LoadU(d, f.receivers.normal[axis].at(f.row, f.column) + i);
  };
  const om::Azimuth<V> azimuth = om::MakeAzimuth(d, ray, f.middle, normal(0), normal(1), normal(2));
  r.ray = ray.length;
  r.back = azimuth.along_ray;
  r.lateral = azimuth.lateral;
  r.camera = p.orthographic ? one : hn::Mul(r.depth, r.ray);
  r.slice = om::MakeSlice(d, azimuth.nz, azimuth.nt, r.camera, perspective);
  r.width = om::AzimuthBetween(d, ray, f.low, f.high);
  return r;
}

// Adds one slice's sums, weighted by w_k, to the row's channels. The tangent is
// (middle - back ray/|ray|) / lateral and the zenith -ray/|ray|, so a direction is summed as its
// share of the plane's u and v axes and of ray/|ray|, which all slices of a receiver have in
// common.
template <SliceSums kSums, class Sums>
HWY_INLINE void AddToRow(const SliceRow& job, const RowFrame& f, const Receivers& r, int i,
                         const Sums& sums) {
  const D d;
  auto add = [&](int channel, V factor, V value) HWY_ATTR {
    float* to = job.out[channel] + i;
    hn::StoreU(hn::MulAdd(factor, value, hn::LoadU(d, to)), d, to);
  };
  if (kSums != SliceSums::kCosine || job.out[0]) add(0, r.width, sums.sum);
  if constexpr (kSums != SliceSums::kVisibility) {
    const V tangent = hn::Div(hn::Mul(r.width, sums.sum_x), r.lateral);
    add(1, tangent, hn::Set(d, f.middle.u));
    add(2, tangent, hn::Set(d, f.middle.v));
    const V along = hn::MulAdd(r.width, sums.sum_y, hn::Mul(tangent, r.back));
    add(3, hn::Set(d, -1.0f), along);
  }
  if constexpr (kSums == SliceSums::kUniform) add(4, r.width, sums.sum_solid);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#endif  // include guard
