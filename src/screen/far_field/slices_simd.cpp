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
HWY_INLINE V SumBetween(const double* from, const double* to) {
  const D d;
  const hn::Half<D> half;
  const hn::Rebind<double, hn::Half<D>> wide;
  const int n = static_cast<int>(hn::Lanes(wide));
  auto part = [&](int i) HWY_ATTR {
    return hn::DemoteTo(half, hn::Sub(hn::LoadU(wide, to + i), hn::LoadU(wide, from + i)));
  };
  return hn::Combine(d, part(n), part(0));
}

template <FalloffKind kKind, bool kChord, SliceSums kSums>
void AddSlices(const SliceRow& job) {
  const D d;
  const Plane& p = *job.plane;
  const RowFrame f(job);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-30f);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < job.count; i += lanes) {
    const Receivers r = MakeReceivers(f, i);
    if (hn::AllFalse(d, r.surface)) continue;
    om::Horizon<D> h = om::StartHorizon<kSums>(d, r.slice, job.tap_count > 0);
    const float* texels = job.texels + i;
    for (int k = 0; k < job.tap_count; ++k) {
      const TapRead& tap = job.taps[k];
      const V wu = hn::Set(d, tap.wu);
      const V c0 = hn::LoadU(d, texels + tap.upper), c1 = hn::LoadU(d, texels + tap.upper_next);
      V g = hn::MulAdd(wu, hn::Sub(c1, c0), c0);
      if (tap.wv > 0) {
        const V e0 = hn::LoadU(d, texels + tap.lower), e1 = hn::LoadU(d, texels + tap.lower_next);
        const V e = hn::MulAdd(wu, hn::Sub(e1, e0), e0);
        g = hn::MulAdd(hn::Set(d, tap.wv), hn::Sub(e, g), g);
      }
      const M valid = hn::And(r.surface, hn::Gt(g, zero));
      const V q = f.DepthOf(hn::Max(g, tiny));
      const V rows = hn::Mul(hn::Set(d, tap.along), p.orthographic ? one : q);
      om::AddPoint<kKind, kChord, false, kSums>(d, *job.rho, r.slice, r.X(rows), r.Y(q, rows),
                                                valid, one, h);
    }
    if (job.far_alone) h.sum = h.sum_x = h.sum_y = h.sum_solid = zero;
    for (int k = 0; k < job.interval_count; ++k) {
      const IntervalRead& read = job.intervals[k];
      const int first = std::clamp(i + read.first, -lanes, job.phase_lines);
      const int last = std::clamp(i + read.last, -lanes, job.phase_lines);
      const V count =
          hn::Sub(hn::LoadU(d, read.to.count + last), hn::LoadU(d, read.from.count + first));
      const M valid = hn::And(r.surface, hn::Gt(count, zero));
      const V inverse = hn::Div(one, hn::Max(count, one));
      const V q = hn::Mul(inverse, SumBetween(read.from.depth + first, read.to.depth + last));
      const V outward =
          hn::Mul(inverse, SumBetween(read.from.outward + first, read.to.outward + last));
      const V rows = hn::MulAdd(outward, hn::Set(d, 1 / p.scale_v),
                                hn::Mul(hn::Set(d, f.axis), p.orthographic ? one : q));
      const V share = hn::Mul(count, hn::Set(d, read.inverse_lines));
      om::AddPoint<kKind, kChord, true, kSums>(d, *job.rho, r.slice, r.X(rows), r.Y(q, rows), valid,
                                               share, h);
    }
    AddToRow<kSums>(job, f, r, i, h);
  }
}

template <FalloffKind kKind, bool kChord>
void AddSlicesOf(const SliceRow& job) {
  switch (job.sums) {
    case SliceSums::kVisibility:
      return AddSlices<kKind, kChord, SliceSums::kVisibility>(job);
    case SliceSums::kUniform:
      return AddSlices<kKind, kChord, SliceSums::kUniform>(job);
    case SliceSums::kCosine:
      return AddSlices<kKind, kChord, SliceSums::kCosine>(job);
  }
}

void AddSlicesAny(const SliceRow& job) {
  math::with_falloff_kind(job.rho->kind, [&]<FalloffKind kKind>() {
    job.chord ? AddSlicesOf<kKind, true>(job) : AddSlicesOf<kKind, false>(job);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(AddSlicesAny);

void add_slices(const SliceRow& job) { HWY_DYNAMIC_DISPATCH(AddSlicesAny)(job); }

}  // namespace obscura::far_field
#endif
