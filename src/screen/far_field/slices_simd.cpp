#include <algorithm>

#include "screen/far_field/slices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/slices_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "screen/far_field/receivers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

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

template <FalloffKind kKind, bool kChord, bool kPartial>
void AddSlices(const SliceRow& job, float* HWY_RESTRICT obscurance) {
  const D d;
  const Plane& p = *job.plane;
  const RowFrame f(job);
  const Segment& s = *job.segment;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-30f);
  for (int x = 0; x < p.visible_width; x += static_cast<int>(hn::Lanes(d))) {
    const int u = x + p.left;
    const Receivers r = MakeReceivers(f, x);
    if (hn::AllFalse(d, r.surface)) continue;
    om::Horizon<D> h = om::StartHorizon(d, r.slice, job.tap_count > 0);
    for (int i = 0; i < job.tap_count; ++i) {
      const NearTap& tap = s.taps[i];
      const float* row = p.lattice.row(f.v + job.sign * tap.dv) + u + tap.du;
      const V wu = hn::Set(d, tap.wu);
      const V c0 = hn::LoadU(d, row), c1 = hn::LoadU(d, row + 1);
      V g = hn::MulAdd(wu, hn::Sub(c1, c0), c0);
      if (tap.wv > 0) {
        const float* next = row + job.sign * p.lattice.stride();
        const V e0 = hn::LoadU(d, next), e1 = hn::LoadU(d, next + 1);
        const V e = hn::MulAdd(wu, hn::Sub(e1, e0), e0);
        g = hn::MulAdd(hn::Set(d, tap.wv), hn::Sub(e, g), g);
      }
      const M valid = hn::And(r.surface, hn::Gt(g, zero));
      const V q = f.DepthOf(hn::Max(g, tiny));
      const V rows = hn::Mul(hn::Set(d, tap.along), p.orthographic ? one : q);
      om::AddPoint<kKind, kChord, false>(d, *job.rho, r.slice, r.X(rows), r.Y(q, rows), valid, one,
                                         h);
    }
    for (int i = 0; i < job.interval_count; ++i) {
      const IntervalRead& read = job.intervals[i];
      const int lanes = static_cast<int>(hn::Lanes(d));
      const int first = std::clamp(u + read.first, -lanes, job.lines);
      const int last = std::clamp(u + read.last, -lanes, job.lines);
      const V count =
          hn::Sub(hn::LoadU(d, read.sums.count + last), hn::LoadU(d, read.sums.count + first));
      const M valid = hn::And(r.surface, hn::Gt(count, zero));
      const V inverse = hn::Div(one, hn::Max(count, one));
      const V q = hn::Mul(inverse, SumBetween(read.sums.depth, first, last));
      const V outward = hn::Mul(inverse, SumBetween(read.sums.outward, first, last));
      const V rows = hn::MulAdd(outward, hn::Set(d, 1 / p.scale_v),
                                hn::Mul(hn::Set(d, f.axis), p.orthographic ? one : q));
      V share = one;
      if constexpr (kPartial) share = hn::Mul(count, hn::Set(d, read.inverse_lines));
      om::AddPoint<kKind, kChord, kPartial>(d, *job.rho, r.slice, r.X(rows), r.Y(q, rows), valid,
                                            share, h);
    }
    const V sum = hn::MulAdd(r.width, h.sum, hn::LoadU(d, obscurance + x));
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
