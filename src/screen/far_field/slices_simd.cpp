#include <algorithm>

#include "screen/far_field/slices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/slices_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/angle-inl.h"
#include "math/slab-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace om = obscura::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// Difference of two prefix sums, each a vector of neighbours from its own start.
HWY_INLINE V SumBetween(const double* sums, int first, int last) {
  const D d;
  const hn::Half<D> half;
  const hn::Rebind<double, hn::Half<D>> wide;
  const int n = static_cast<int>(hn::Lanes(wide));
  auto part = [&](int i) HWY_ATTR {
    return hn::DemoteTo(
        half, hn::Sub(hn::LoadU(wide, sums + last + i), hn::LoadU(wide, sums + first + i)));
  };
  return hn::Combine(d, part(n), part(0));
}

// A vector of receivers and the geometry of one segment around them.
struct Receivers {
  V depth, ray;        // depth and length of the ray at depth 1
  V tangent, towards;  // per row and depth: coordinate along the tangent, and against the zenith
  V width;             // w_k
  M surface;
};

// e = (slope scale_u, sign scale_v, 0), one row outwards at depth 1, against the ray (a, b, 1).
struct Step {
  float u, v;
};
HWY_INLINE V AlongRay(Step e, V a, V b, V inverse_ray) {
  const D d;
  return hn::Mul(hn::MulAdd(hn::Set(d, e.u), a, hn::Mul(hn::Set(d, e.v), b)), inverse_ray);
}

template <FalloffKind kKind, bool kChord, bool kPartial>
void AddSlices(const SliceRow& job, float* HWY_RESTRICT obscurance) {
  const D d;
  const Plane& p = *job.plane;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-30f);
  const int v = job.row + p.top;
  const float v_axis = static_cast<float>(v) - p.center_v;
  const V perspective = hn::Set(d, p.orthographic ? 0.0f : 1.0f);
  const V kappa = hn::Set(d, p.kappa);
  auto depth_of = [&](V g)
                      HWY_ATTR { return p.orthographic ? hn::Sub(kappa, g) : hn::Div(one, g); };
  const Segment& s = *job.segment;
  const float sign = static_cast<float>(job.sign);
  const Step middle{s.middle * p.scale_u, sign * p.scale_v};
  const Step low{s.low * p.scale_u, sign * p.scale_v};
  const Step high{s.high * p.scale_u, sign * p.scale_v};
  const float step_square = middle.u * middle.u + middle.v * middle.v;
  // In rows outwards: where the axis is, and a world length.
  const V axis = hn::Set(d, -sign * v_axis);
  const V to_rows = hn::Set(d, 1 / p.scale_v);

  for (int x = 0; x < p.visible_width; x += static_cast<int>(hn::Lanes(d))) {
    const int u = x + p.left;
    const V g0 = hn::LoadU(d, p.lattice.row(v) + u);
    const M surface = hn::Gt(g0, zero);
    if (hn::AllFalse(d, surface)) continue;
    const V depth = depth_of(hn::IfThenElse(surface, g0, one));

    // The ray (a, b, 1) at depth 1 and the slice's frame: zenith -ray/|ray|, tangent the part of
    // `middle` at right angles to it.
    const V u_axis = hn::Add(hn::Iota(d, static_cast<float>(u)), hn::Set(d, -p.center_u));
    const V a = hn::Mul(perspective, hn::Mul(u_axis, hn::Set(d, p.scale_u)));
    const V b = hn::Mul(perspective, hn::Set(d, v_axis * p.scale_v));
    const V ray = hn::Sqrt(hn::MulAdd(a, a, hn::MulAdd(b, b, one)));
    const V inverse_ray = hn::Div(one, ray);
    const V back = AlongRay(middle, a, b, inverse_ray);
    const V lateral = hn::Sqrt(hn::Max(hn::NegMulAdd(back, back, hn::Set(d, step_square)), tiny));
    const V nu = hn::LoadU(d, p.normal_u.row(job.row) + x);
    const V nv = hn::LoadU(d, p.normal_v.row(job.row) + x);
    const V nw = hn::LoadU(d, p.normal_w.row(job.row) + x);
    const V nz = hn::Neg(hn::Mul(hn::MulAdd(nu, a, hn::MulAdd(nv, b, nw)), inverse_ray));
    const V along = hn::MulAdd(nu, hn::Set(d, middle.u), hn::Mul(nv, hn::Set(d, middle.v)));
    const V nt = hn::Div(hn::MulAdd(nz, back, along), lateral);
    const V camera = p.orthographic ? one : hn::Mul(depth, ray);
    const om::Slice<V> slice = om::MakeSlice(d, nz, nt, camera, perspective);

    // The angle around the zenith between the segment's edges.
    const V back_low = AlongRay(low, a, b, inverse_ray),
            back_high = AlongRay(high, a, b, inverse_ray);
    const V cross = hn::Mul(inverse_ray, hn::Set(d, std::abs(low.u * high.v - low.v * high.u)));
    const V dot = hn::NegMulAdd(back_low, back_high, hn::Set(d, low.u * high.u + low.v * high.v));
    const V width = om::FastAcos(
        d, hn::Div(dot, hn::Sqrt(hn::Max(hn::MulAdd(dot, dot, hn::Mul(cross, cross)), tiny))));

    om::Horizon<D> h = om::StartHorizon(d, slice, job.tap_count > 0);
    // A point `rows` outwards (times its depth, in perspective) on the segment's middle line:
    // p - receiver = (depth' - depth) (a, b, 1) + rows middle.
    auto x_of = [&](V rows) HWY_ATTR { return hn::Abs(hn::Mul(rows, lateral)); };
    auto y_of = [&](V point_depth, V rows) HWY_ATTR {
      return hn::NegMulAdd(rows, back, hn::Mul(ray, hn::Sub(depth, point_depth)));
    };
    for (int i = 0; i < job.tap_count; ++i) {
      const NearTap& tap = s.taps[i];
      const float* row = p.lattice.row(v + job.sign * tap.dv) + u + tap.du;
      const V wu = hn::Set(d, tap.wu);
      const V c0 = hn::LoadU(d, row), c1 = hn::LoadU(d, row + 1);
      V g = hn::MulAdd(wu, hn::Sub(c1, c0), c0);
      if (tap.wv > 0) {
        const float* next = row + job.sign * p.lattice.stride();
        const V e0 = hn::LoadU(d, next), e1 = hn::LoadU(d, next + 1);
        const V e = hn::MulAdd(wu, hn::Sub(e1, e0), e0);
        g = hn::MulAdd(hn::Set(d, tap.wv), hn::Sub(e, g), g);
      }
      const M valid = hn::And(surface, hn::Gt(g, zero));
      const V q = depth_of(hn::Max(g, tiny));
      const V rows = hn::Mul(hn::Set(d, tap.along), p.orthographic ? one : q);
      om::AddPoint<kKind, kChord, false>(d, *job.rho, slice, x_of(rows), y_of(q, rows), valid, one,
                                         h);
    }
    for (int i = 0; i < job.interval_count; ++i) {
      const IntervalRead& read = job.intervals[i];
      const int lanes = static_cast<int>(hn::Lanes(d));
      const int first = std::clamp(u + read.first, -lanes, job.lines);
      const int last = std::clamp(u + read.last, -lanes, job.lines);
      const V count =
          hn::Sub(hn::LoadU(d, read.sums.count + last), hn::LoadU(d, read.sums.count + first));
      const M valid = hn::And(surface, hn::Gt(count, zero));
      const V inverse = hn::Div(one, hn::Max(count, one));
      const V q = hn::Mul(inverse, SumBetween(read.sums.depth, first, last));
      const V outward = hn::Mul(inverse, SumBetween(read.sums.outward, first, last));
      const V rows = hn::MulAdd(outward, to_rows, hn::Mul(axis, p.orthographic ? one : q));
      V share = one;
      if constexpr (kPartial) share = hn::Mul(count, hn::Set(d, read.inverse_lines));
      om::AddPoint<kKind, kChord, kPartial>(d, *job.rho, slice, x_of(rows), y_of(q, rows), valid,
                                            share, h);
    }
    const V sum = hn::MulAdd(width, h.sum, hn::LoadU(d, obscurance + x));
    hn::StoreU(sum, d, obscurance + x);
  }
}

template <FalloffKind kKind>
void AddSlicesOf(const SliceRow& job, float* obscurance) {
  if (job.chord) {
    job.partial ? AddSlices<kKind, true, true>(job, obscurance)
                : AddSlices<kKind, true, false>(job, obscurance);
  } else {
    job.partial ? AddSlices<kKind, false, true>(job, obscurance)
                : AddSlices<kKind, false, false>(job, obscurance);
  }
}

void AddSlicesAny(const SliceRow& job, float* obscurance) {
  math::with_falloff_kind(job.rho->kind,
                          [&]<FalloffKind kKind>() { AddSlicesOf<kKind>(job, obscurance); });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(AddSlicesAny);

void add_slices(const SliceRow& job, float* obscurance) {
  HWY_DYNAMIC_DISPATCH(AddSlicesAny)(job, obscurance);
}

}  // namespace obscura::far_field
#endif
