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
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), tiny = hn::Set(d, leaf::kSmallest);
  const int lanes = static_cast<int>(hn::Lanes(d));
  leaf::SliceIntegral<kKind, kChord, kSums> slices(*job.rho);
  for (int i = job.begin; i < job.count; i += lanes) {
    const Receivers r = MakeReceivers(f, i);
    if (hn::AllFalse(d, r.surface)) continue;
    const leaf::Part& part = r.part;
    const V limit = slices.depth_without_effect(part.depth);
    leaf::Horizon h = slices.start_horizon(part.slice, job.tap_count > 0);
    const float* texels = job.texels + i;
    for (int k = 0; k < job.tap_count; ++k) {
      const TapRead& tap = job.taps[k];
      const V wu = hn::Set(d, tap.wu);
      const bool parallel = p.orthographic;
      const V c0 = hn::LoadU(d, texels + tap.upper), c1 = hn::LoadU(d, texels + tap.upper_next);
      V nearest = leaf::nearest_of_lattice(c0, c1, parallel);
      auto blended = [&](V a, V b) HWY_ATTR {
        return leaf::blended(leaf::texel_beside(nearest, a, parallel),
                             leaf::texel_beside(nearest, b, parallel), wu);
      };
      V g;
      if (tap.wv > 0) {
        const V e0 = hn::LoadU(d, texels + tap.lower), e1 = hn::LoadU(d, texels + tap.lower_next);
        nearest =
            leaf::nearest_of_lattice(nearest, leaf::nearest_of_lattice(e0, e1, parallel), parallel);
        g = leaf::blended(blended(c0, c1), blended(e0, e1), hn::Set(d, tap.wv));
      } else {
        g = blended(c0, c1);
      }
      const V q = f.DepthOf(hn::Max(g, tiny));
      const M valid = hn::And(hn::And(r.surface, hn::Gt(g, zero)), hn::Lt(q, limit));
      const V rows = hn::Mul(hn::Set(d, tap.along), p.orthographic ? one : q);
      slices.add_point(part.slice, leaf::part_x(part, rows), leaf::part_y(part, q, rows), valid,
                       false, one, h);
    }
    for (int k = 0; k < job.interval_count; ++k) {
      const IntervalRead& read = job.intervals[k];
      const LineWindow& window = read.from.window;
      const int first = std::clamp(i + read.first, window.begin - lanes, window.end);
      const int last = std::clamp(i + read.last, window.begin - lanes, window.end);
      const V count =
          hn::Sub(hn::LoadU(d, read.to.count + last), hn::LoadU(d, read.from.count + first));
      const V inverse = hn::Div(one, hn::Max(count, one));
      const V q = hn::Mul(inverse, SumBetween(read.from.depth + first, read.to.depth + last));
      const M valid = hn::And(hn::And(r.surface, hn::Gt(count, zero)), hn::Lt(q, limit));
      const V outward =
          hn::Mul(inverse, SumBetween(read.from.outward + first, read.to.outward + last));
      const V rows = hn::MulAdd(outward, hn::Set(d, 1 / p.scale_v),
                                hn::Mul(hn::Set(d, f.axis), p.orthographic ? one : q));
      const V share = hn::Mul(count, hn::Set(d, read.inverse_lines));
      slices.add_point(part.slice, leaf::part_x(part, rows), leaf::part_y(part, q, rows), valid,
                       true, share, h);
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
