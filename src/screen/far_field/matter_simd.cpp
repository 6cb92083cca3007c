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

// A direct sample: blended between four texels of one surface, otherwise the nearest of them.
struct Sample {
  V depth, back;
  M valid;
};
HWY_INLINE Sample ReadTap(const SliceRow& job, const RowFrame& f, const NearTap& tap, int u) {
  const D d;
  const Plane& p = f.plane;
  const V tiny = hn::Set(d, 1e-30f);
  const int row = f.v + job.sign * tap.dv, next = tap.wv > 0 ? row + job.sign : row;
  const float* upper = p.lattice.row(row) + u + tap.du;
  const float* lower = p.lattice.row(next) + u + tap.du;
  const V a = hn::LoadU(d, upper), b = hn::LoadU(d, upper + 1);
  const V c = hn::LoadU(d, lower), e = hn::LoadU(d, lower + 1);
  const bool right = tap.wu >= 0.5f, below = tap.wv >= 0.5f;
  const V nearest = below ? (right ? e : c) : (right ? b : a);
  const float* back_row = p.back.row(below ? next : row) + u + tap.du;
  const V back = hn::LoadU(d, back_row + right);
  const V wu = hn::Set(d, tap.wu);
  const V top = hn::MulAdd(wu, hn::Sub(b, a), a), bottom = hn::MulAdd(wu, hn::Sub(e, c), c);
  const V blended = hn::MulAdd(hn::Set(d, tap.wv), hn::Sub(bottom, top), top);
  const V least = hn::Min(hn::Min(a, b), hn::Min(c, e));
  const V most = hn::Max(hn::Max(a, b), hn::Max(c, e));
  const V far = f.DepthOf(hn::Max(least, tiny)), near = f.DepthOf(hn::Max(most, tiny));
  const V own = f.DepthOf(hn::Max(nearest, tiny));
  const V reach = hn::MulAdd(hn::Set(d, job.slack), near, hn::Sub(back, own));
  const M smooth = hn::And(hn::Gt(least, hn::Zero(d)), hn::Le(hn::Sub(far, near), reach));
  const V g = hn::IfThenElse(smooth, blended, nearest);
  const V depth = f.DepthOf(hn::Max(g, tiny));
  return {depth, hn::Max(back, depth), hn::Gt(g, hn::Zero(d))};
}

template <FalloffKind kKind>
void AddMatterSlices(const SliceRow& job, float* HWY_RESTRICT obscurance) {
  const D d;
  const Plane& p = *job.plane;
  const RowFrame f(job);
  const V one = hn::Set(d, 1.0f), inf = hn::Inf(d);
  const V slack = hn::Set(d, job.slack);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < p.visible_width; x += lanes) {
    const int u = x + p.left;
    const Receivers r = MakeReceivers(f, x);
    if (hn::AllFalse(d, r.surface)) continue;
    const V own_back = hn::Max(hn::LoadU(d, p.back.row(f.v) + u), r.depth);
    om::Sectors<D> m = om::StartSectors(d, r.slice, job.tap_count > 0, r.depth, own_back);
    auto add = [&](V depth, V back, V rows, M valid) HWY_ATTR {
      const V px = r.X(rows), py = r.Y(depth, rows);
      // The matter's end lies on the same view ray.
      const V scale = hn::Mul(back, om::FastReciprocal(d, depth));
      const V bx = p.orthographic ? px : hn::Mul(px, scale);
      const V by = p.orthographic ? hn::Sub(py, hn::Sub(back, depth))
                                  : hn::MulAdd(hn::Sub(py, r.camera), scale, r.camera);
      om::AddMatter<kKind>(d, *job.rho, r.slice, px, py, bx, by, depth, back, hn::Mul(slack, depth),
                           job.dither, hn::And(valid, r.surface), m);
    };
    for (int i = 0; i < job.tap_count; ++i) {
      const NearTap& tap = job.segment->taps[i];
      const Sample s = ReadTap(job, f, tap, u);
      add(s.depth, s.back, hn::Mul(hn::Set(d, tap.along), p.orthographic ? one : s.depth), s.valid);
    }
    for (int i = 0; i < job.interval_count; ++i) {
      const IntervalRead& read = job.intervals[i];
      const int line = std::clamp(u + read.middle, -PrefixSums::kPadding, job.lines);
      const V nearest = hn::LoadU(d, read.nearest + line);
      const M valid = hn::Lt(nearest, inf);
      const V depth = hn::IfThenElse(valid, nearest, one);
      const V slanted = hn::IfThenElse(valid, hn::LoadU(d, read.slanted + line), one);
      const V back = hn::IfThenElse(valid, hn::LoadU(d, read.deepest + line), one);
      const V outward = hn::Mul(hn::Set(d, job.slope / p.scale_v), hn::Add(slanted, depth));
      const V rows = hn::MulAdd(hn::Set(d, f.axis), p.orthographic ? one : depth, outward);
      add(depth, back, rows, valid);
    }
    hn::StoreU(hn::MulAdd(r.width, m.sum, hn::LoadU(d, obscurance + x)), d, obscurance + x);
  }
}

void AddMatterSlicesAny(const SliceRow& job, float* obscurance) {
  math::with_falloff_kind(job.rho->kind,
                          [&]<FalloffKind kKind>() { AddMatterSlices<kKind>(job, obscurance); });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(AddMatterSlicesAny);

void add_matter_slices(const SliceRow& job, float* obscurance) {
  HWY_DYNAMIC_DISPATCH(AddMatterSlicesAny)(job, obscurance);
}

}  // namespace obscura::far_field
#endif
