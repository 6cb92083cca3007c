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

struct Sample {
  V depth, back;
  M valid;
};
HWY_INLINE Sample ReadTap(const SliceRow& job, const RowFrame& f, const TapRead& tap, int i) {
  const D d;
  const float* texels = job.texels + i;
  const V a = hn::LoadU(d, texels + tap.upper), b = hn::LoadU(d, texels + tap.upper_next);
  const V c = hn::LoadU(d, texels + tap.lower), e = hn::LoadU(d, texels + tap.lower_next);
  const float* backs = job.backs + i;
  const V back = hn::LoadU(d, backs + tap.nearest);
  const V first_back =
      hn::Min(hn::Min(hn::LoadU(d, backs + tap.upper), hn::LoadU(d, backs + tap.upper_next)),
              hn::Min(hn::LoadU(d, backs + tap.lower), hn::LoadU(d, backs + tap.lower_next)));
  const bool right = tap.wu >= 0.5f, below = tap.wv >= 0.5f;
  const V nearest = below ? (right ? e : c) : (right ? b : a);
  const leaf::MatterTap found = leaf::matter_tap(
      a, b, c, e, hn::Set(d, tap.wu), hn::Set(d, tap.wv), nearest, back, first_back,
      hn::Set(d, job.slack), hn::Set(d, f.plane.ortho_offset), f.plane.orthographic);
  return {found.depth, found.back,
          tap.centred ? found.surface : hn::And(found.surface, found.smooth_here)};
}

template <FalloffKind kKind, SliceSums kSums>
void AddMatterSlices(const SliceRow& job) {
  const D d;
  const Plane& p = *job.plane;
  const RowFrame f(job);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), inf = hn::Inf(d);
  const V slack = hn::Set(d, job.slack), dither = hn::Set(d, job.dither);
  leaf::SliceIntegral<kKind, true, kSums> slices(*job.rho);
  const int lanes = static_cast<int>(hn::Lanes(d));
  const float* own_back = p.back.at(job.row + p.top, job.column + p.left);
  for (int i = 0; i < job.count; i += lanes) {
    const Receivers r = MakeReceivers(f, i);
    if (hn::AllFalse(d, r.surface)) continue;
    const leaf::Part& part = r.part;
    leaf::Sectors m = leaf::start_sectors(part.slice, job.tap_count > 0, part.depth,
                                          hn::Max(hn::LoadU(d, own_back + i), part.depth));
    auto add = [&](V depth, V back, V rows, M valid) HWY_ATTR {
      const V x = leaf::part_x(part, rows), y = leaf::part_y(part, depth, rows);
      const leaf::MatterEnd end = leaf::matter_end(part, x, y, depth, back, p.orthographic);
      slices.add_matter(part.slice, x, y, end.x, end.y, depth, back, hn::Mul(slack, depth), dither,
                        hn::And(valid, r.surface), m);
    };
    for (int k = 0; k < job.tap_count; ++k) {
      const TapRead& tap = job.taps[k];
      const Sample s = ReadTap(job, f, tap, i);
      add(s.depth, s.back, hn::Mul(hn::Set(d, tap.along), p.orthographic ? one : s.depth), s.valid);
    }
    if (job.far_alone) m.sum = m.sum_x = m.sum_y = m.sum_solid = zero;
    for (int k = 0; k < job.interval_count; ++k) {
      const IntervalRead& read = job.intervals[k];
      const int line = std::clamp(i + read.middle, -PrefixSums::kPadding, job.phase_lines);
      const V nearest = hn::LoadU(d, read.line.nearest + line);
      const M valid = hn::Lt(nearest, inf);
      const V depth = hn::IfThenElse(valid, nearest, one);
      const V slanted = hn::IfThenElse(valid, hn::LoadU(d, read.line.slanted + line), one);
      const V back = hn::IfThenElse(valid, hn::LoadU(d, read.line.deepest + line), one);
      const V outward = leaf::outward_of(hn::Set(d, job.slope / p.scale_v), depth, slanted);
      const V rows = hn::MulAdd(hn::Set(d, f.axis), p.orthographic ? one : depth, outward);
      add(depth, back, rows, valid);
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
