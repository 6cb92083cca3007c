#include <algorithm>

#include "screen/far_field/slices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/matter_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "screen/far_field/receivers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

template <FalloffKind kKind, SliceSums kSums>
void AddMatterSlices(const SliceRow& job) {
  const D d;
  const Plane& p = *job.plane;
  const RowFrame f(job);
  const V one = hn::Set(d, 1.0f), inf = hn::Inf(d);
  const V slack = hn::Set(d, job.slack), dither = hn::Set(d, job.dither);
  leaf::SliceIntegral<kKind, true, kSums> slices(*job.rho);
  const int lanes = static_cast<int>(hn::Lanes(d));
  const float* own_back = p.back.at(job.row + p.top, job.column + p.left);
  for (int i = job.begin; i < job.count; i += lanes) {
    const Receivers r = MakeReceivers(f, i);
    if (hn::AllFalse(d, r.surface)) continue;
    const leaf::Part& part = r.part;
    leaf::Sectors m = leaf::start_sectors(part.slice, job.tap_count > 0, part.depth,
                                          hn::Max(hn::LoadU(d, own_back + i), part.depth));
    const V limit = slices.depth_without_effect(part.depth);
    auto add = [&](V depth, V back, V rows, V first, V last, M valid) HWY_ATTR {
      const leaf::MatterBox box =
          leaf::matter_box(part, rows, first, last, depth, back, p.orthographic);
      const M next = hn::Lt(hn::Sub(first, m.last_row), hn::Set(d, leaf::kNextRow));
      slices.add_matter(part.slice, box, next, hn::Mul(slack, depth), dither,
                        hn::And(hn::And(valid, r.surface), hn::Lt(depth, limit)), m);
    };
    for (int k = 0; k < job.tap_count; ++k) {
      const TapRead& tap = job.taps[k];
      const float *texels = job.texels + i, *backs = job.backs + i;
      const leaf::Crossing c = leaf::cross_matter(
          hn::LoadU(d, texels + tap.upper), hn::LoadU(d, texels + tap.upper_next),
          hn::LoadU(d, backs + tap.upper), hn::LoadU(d, backs + tap.upper_next), hn::Set(d, tap.wu),
          leaf::leaf_truth(tap.wu < 0.5f), slack, p.orthographic);
      const V row = hn::Set(d, tap.along);
      add(c.depth, c.back, p.orthographic ? row : hn::Mul(row, c.depth), row, row, c.surface);
    }
    for (int k = 0; k < job.interval_count; ++k) {
      const IntervalRead& read = job.intervals[k];
      const int line = std::clamp(i + read.middle, read.line.window.begin - PrefixSums::kPadding,
                                  read.line.window.end);
      const V nearest = hn::LoadU(d, read.line.nearest + line);
      const M valid = hn::Lt(nearest, inf);
      const V depth = hn::IfThenElse(valid, nearest, one);
      const V slanted = hn::IfThenElse(valid, hn::LoadU(d, read.line.slanted + line), one);
      const V back = hn::IfThenElse(valid, hn::LoadU(d, read.line.deepest + line), one);
      const V per_row = hn::Set(d, 1 / p.scale_v);
      const V axis = hn::Set(d, f.axis);
      const V rows = hn::MulAdd(leaf::outward_of(hn::Set(d, job.slope), depth, slanted), per_row,
                                p.orthographic ? axis : hn::Mul(axis, depth));
      auto row_of = [&](const float* outward) HWY_ATTR {
        return hn::MulAdd(hn::LoadU(d, outward + line), per_row, axis);
      };
      add(depth, back, rows, row_of(read.line.begin), row_of(read.line.end), valid);
      const leaf::Rest rest{hn::LoadU(d, read.line.rest_front + line),
                            hn::LoadU(d, read.line.rest_back + line),
                            hn::LoadU(d, read.line.rest_filled + line)};
      const M more = hn::And(hn::Lt(rest.front, limit), r.surface);
      if (!hn::AllFalse(d, more)) {
        const V front = hn::IfThenElse(more, rest.front, one);
        const V row = hn::Set(d, read.away);
        const leaf::MatterBox box =
            leaf::matter_box(part, p.orthographic ? row : hn::Mul(row, front), row, row, front,
                             hn::Max(rest.back, front), p.orthographic);
        slices.add_spread(part.slice, box, leaf::rest_share(rest), dither, k, more, m);
      }
    }
    AddToRow<kSums>(job, f, r, i, m);
  }
}

void AddMatterSlicesAny(const SliceRow& job) {
  math::with_falloff_kind(job.rho->kind, [&]<FalloffKind kKind>() {
    switch (job.sums) {
      case SliceSums::kVisibility:
        return AddMatterSlices<kKind, SliceSums::kVisibility>(job);
      case SliceSums::kUniform:
        return AddMatterSlices<kKind, SliceSums::kUniform>(job);
      case SliceSums::kCosine:
        return AddMatterSlices<kKind, SliceSums::kCosine>(job);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(AddMatterSlicesAny);

void add_matter_slices(const SliceRow& job) { HWY_DYNAMIC_DISPATCH(AddMatterSlicesAny)(job); }

}  // namespace obscura::far_field
#endif
