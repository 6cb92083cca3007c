// Receivers of a row and the slice of one segment around each; included once per SIMD target.
#if defined(OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#undef OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#else
#define OBSCURA_SRC_SCREEN_FAR_FIELD_RECEIVERS_INL_H_
#endif

#include "hwy/highway.h"
#include "math/slice-inl.h"
#include "screen/far_field/slices.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "view/taps_leaf.h"
// After taps_leaf.h.
#include "math/apart_leaf.h"
#include "screen/far_field/lattice_leaf.h"
// After lattice_leaf.h.
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/slices_leaf.h"
// After slices_leaf.h.
#include "screen/far_field/box_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace far_field::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace leaf = obscura::HWY_NAMESPACE::leaf;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// An image direction at depth 1: pixels times the size of a pixel.
struct ImageStep {
  float u, v;
};

// What is the same for all receivers of a row.
struct RowFrame {
  explicit RowFrame(const SliceRow& job)
      : plane(*job.plane),
        receivers(job.plane->receivers),
        row(job.row),
        column(job.column),
        v_axis(static_cast<float>(job.row + plane.top) - plane.center_v) {
    const float sign = static_cast<float>(job.sign);
    auto step = [&](float slope) { return ImageStep{slope * plane.scale_u, sign * plane.scale_v}; };
    middle = step(job.segment->middle);
    low = step(job.segment->low);
    high = step(job.segment->high);
    axis = -sign * v_axis;
  }

  HWY_INLINE V DepthOf(V g) const { return leaf::near_depth_of_lattice(g, plane.orthographic); }

  const Plane& plane;
  const ReceiverImages& receivers;
  int row, column;
  float v_axis;                 // rows from the camera's axis
  float axis;                   // the axis, in rows outwards from the receiver
  ImageStep middle, low, high;  // one row outwards
};

// A vector of receivers and the slice of one segment around each.
struct Receivers {
  leaf::Part part;
  M surface;
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
  const V depth = f.DepthOf(hn::IfThenElse(r.surface, g, one));

  const int phases = p.lattice.phases();
  const float first = static_cast<float>(f.column + i * phases + p.left) - p.center_u;
  const V u_axis =
      hn::MulAdd(hn::Iota(d, 0), hn::Set(d, static_cast<float>(phases)), hn::Set(d, first));
  const V a = hn::Mul(perspective, hn::Mul(u_axis, hn::Set(d, p.scale_u)));
  const V b = hn::Mul(perspective, hn::Set(d, f.v_axis * p.scale_v));
  const leaf::ViewRay ray = leaf::make_ray(a, b);
  auto normal = [&](int axis) HWY_ATTR {
    return hn::LoadU(d, f.receivers.normal[axis].at(f.row, f.column) + i);
  };
  r.part = leaf::make_part(ray, depth, normal(0), normal(1), normal(2), hn::Set(d, f.middle.u),
                           hn::Set(d, f.middle.v), hn::Set(d, f.low.u), hn::Set(d, f.low.v),
                           hn::Set(d, f.high.u), hn::Set(d, f.high.v), p.orthographic);
  return r;
}

// Adds one slice's sums, weighted by w_k, to the row's channels: as shares of the plane's u and v
// axes and of ray/|ray|.
template <SliceSums kSums, class Sums>
HWY_INLINE void AddToRow(const SliceRow& job, const RowFrame& f, const Receivers& r, int i,
                         const Sums& sums) {
  const D d;
  auto add = [&](int channel, V factor, V value) HWY_ATTR {
    float* to = job.out[channel] + i;
    hn::StoreU(hn::MulAdd(factor, value, hn::LoadU(d, to)), d, to);
  };
  if (kSums != SliceSums::kCosine || job.out[0]) add(0, r.part.width, sums.sum);
  if constexpr (kSums != SliceSums::kVisibility) {
    const V tangent = leaf::share_of_middle(r.part, sums.sum_x);
    add(1, tangent, hn::Set(d, f.middle.u));
    add(2, tangent, hn::Set(d, f.middle.v));
    const V along = leaf::share_of_ray(r.part, sums.sum_y, tangent);
    add(3, hn::Set(d, -1.0f), along);
  }
  if constexpr (kSums == SliceSums::kUniform) add(4, r.part.width, sums.sum_solid);
}

}  // namespace far_field::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
