#include <algorithm>

#include "screen/far_field/slices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/matter_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/matter-inl.h"
#include "screen/far_field/receivers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

// A direct sample: blended between four texels of one surface, otherwise the nearest of them. That
// one stands at its own row only: taken at several places it would be a step of the height of a
// texel in every surface that is not blended, which rods and edges would cast on themselves.
struct Sample {
  V depth, back;
  M valid;
};
HWY_INLINE Sample ReadTap(const SliceRow& job, const RowFrame& f, const TapRead& tap, int i) {
  const D d;
  const V tiny = hn::Set(d, 1e-30f);
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
  const V wu = hn::Set(d, tap.wu);
  const V top = hn::MulAdd(wu, hn::Sub(b, a), a), bottom = hn::MulAdd(wu, hn::Sub(e, c), c);
  const V blended = hn::MulAdd(hn::Set(d, tap.wv), hn::Sub(bottom, top), top);
  const V least = hn::Min(hn::Min(a, b), hn::Min(c, e));
  const V most = hn::Max(hn::Max(a, b), hn::Max(c, e));
  const V far = f.DepthOf(hn::Max(least, tiny)), near = f.DepthOf(hn::Max(most, tiny));
  const M touch = hn::Le(hn::Sub(far, first_back), hn::Mul(hn::Set(d, job.slack), near));
  const M smooth = hn::And(hn::Gt(least, hn::Zero(d)), touch);
  const V g = hn::IfThenElse(smooth, blended, nearest);
  const V depth = f.DepthOf(hn::Max(g, tiny));
  const M surface = hn::Gt(g, hn::Zero(d));
  return {depth, hn::Max(back, depth), tap.centred ? surface : hn::And(surface, smooth)};
}

template <FalloffKind kKind, SliceSums kSums>
void AddMatterSlices(const SliceRow& job) {
  const D d;
  const Plane& p = *job.plane;
  const RowFrame f(job);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), inf = hn::Inf(d);
  const V slack = hn::Set(d, job.slack);
  const int lanes = static_cast<int>(hn::Lanes(d));
  const float* own_back = p.back.at(job.row + p.top, job.column + p.left);
  for (int i = 0; i < job.count; i += lanes) {
    const Receivers r = MakeReceivers(f, i);
    if (hn::AllFalse(d, r.surface)) continue;
    om::Sectors<D> m = om::StartSectors(d, r.slice, job.tap_count > 0, r.depth,
                                        hn::Max(hn::LoadU(d, own_back + i), r.depth));
    auto add = [&](V depth, V back, V rows, M valid) HWY_ATTR {
      const V px = r.X(rows), py = r.Y(depth, rows);
      // The matter's end lies on the same view ray.
      const V scale = hn::Mul(back, om::FastReciprocal(d, depth));
      const V bx = p.orthographic ? px : hn::Mul(px, scale);
      const V by = p.orthographic ? hn::Sub(py, hn::Sub(back, depth))
                                  : hn::MulAdd(hn::Sub(py, r.camera), scale, r.camera);
      om::AddMatter<kKind, kSums>(d, *job.rho, r.slice, px, py, bx, by, depth, back,
                                  hn::Mul(slack, depth), job.dither, hn::And(valid, r.surface), m);
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
      const V outward = hn::Mul(hn::Set(d, job.slope / p.scale_v), hn::Add(slanted, depth));
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
