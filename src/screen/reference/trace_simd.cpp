#include <algorithm>
#include <limits>

#include "screen/reference/rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/reference/trace_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"

// One ray per lane, each on its own way down and up the pyramid; a lane whose ray has ended takes
// the next one of the batch. A ray passes a block of cells unseen when it stays higher than
// everything in it (or, with matter that has a back, lower), else it looks into the block's four
// parts. In a single cell it is intersected exactly.
HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;
constexpr int kMaxLanes = HWY_MAX_BYTES / sizeof(float);
constexpr float kInfinity = std::numeric_limits<float>::infinity();

HWY_INLINE V Gather(const float* base, VI index) {
  HWY_ALIGN std::int32_t at[kMaxLanes];
  hn::Store(index, DI(), at);
  return GatherLanes(D(), base, at);
}

// A ray's way through one cell, between s0 and s1.
struct Segment {
  V s0, s1;
  V h0, h1;   // the ray's heights there
  VI ix, iy;  // the cell
};

// The rays that the lanes follow.
struct Lanes {
  V x, y, h, reference, gx, gy, gh, end;
  V per_gx, per_gy;
  VI step_x, step_y;  // 1 to the right or down, else 0
  V s;
  VI ix, iy, level;
};

// The surface in a cell, bilinear between its corners: along a ray its height is quadratic.
// Returns s of the first point at which the ray is behind it, or infinity.
HWY_INLINE V HitSurface(const TraceScene& scene, const Lanes& ray, const Segment& c) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const VI stride = hn::Set(di, static_cast<std::int32_t>(scene.stride));
  const VI at = hn::Add(hn::Mul(hn::Sub(c.iy, hn::Set(di, scene.middle)), stride), c.ix);
  const float* below = scene.heights + scene.stride;
  const V h00 = hn::Sub(Gather(scene.heights, at), ray.reference);
  const V h10 = hn::Sub(Gather(scene.heights + 1, at), ray.reference);
  const V h01 = hn::Sub(Gather(below, at), ray.reference);
  const V h11 = hn::Sub(Gather(below + 1, at), ray.reference);
  const V x = hn::Sub(ray.x, hn::ConvertTo(d, c.ix)), y = hn::Sub(ray.y, hn::ConvertTo(d, c.iy));
  const V x0 = hn::MulAdd(c.s0, ray.gx, x), y0 = hn::MulAdd(c.s0, ray.gy, y);
  const V x1 = hn::MulAdd(c.s1, ray.gx, x), y1 = hn::MulAdd(c.s1, ray.gy, y);
  // In this form exact at the corners, so that a start close above one is not taken for behind it.
  auto surface = [&](V u, V v) HWY_ATTR {
    const V ru = hn::Sub(one, u), rv = hn::Sub(one, v);
    const V top = hn::MulAdd(ru, h00, hn::Mul(u, h10));
    const V bottom = hn::MulAdd(ru, h01, hn::Mul(u, h11));
    return hn::MulAdd(rv, top, hn::Mul(v, bottom));
  };
  // Ray above surface: f(t) = f0 + b t + a t^2, t in [0, 1] from s0 to s1.
  const V f0 = hn::Sub(c.h0, surface(x0, y0)), f1 = hn::Sub(c.h1, surface(x1, y1));
  const V twist = hn::Sub(hn::Add(h00, h11), hn::Add(h10, h01));
  const V a = hn::Neg(hn::Mul(twist, hn::Mul(hn::Sub(x1, x0), hn::Sub(y1, y0))));
  const V b = hn::Sub(hn::Sub(f1, f0), a);
  // The smaller positive root, in the form that does not cancel; the larger where a < 0.
  const V discriminant = hn::NegMulAdd(hn::Mul(hn::Set(d, 4.0f), a), f0, hn::Mul(b, b));
  const V root = hn::Div(hn::Add(f0, f0), hn::Sub(hn::Sqrt(hn::Max(discriminant, zero)), b));
  const M behind = hn::Lt(f0, zero);
  const M crosses = hn::Lt(f1, zero);
  const M dips = hn::And(hn::And(hn::Gt(discriminant, zero), hn::Gt(a, zero)),
                         hn::And(hn::Lt(b, zero), hn::Lt(hn::Neg(b), hn::Add(a, a))));
  // If f1 < 0 there is a root in (0, 1]; rounding must not lose it.
  const V t = hn::IfThenElse(behind, zero, hn::Min(hn::Max(root, zero), one));
  const M hit = hn::Or(behind, hn::Or(crosses, dips));
  return hn::IfThenElse(hit, hn::MulAdd(t, hn::Sub(c.s1, c.s0), c.s0), hn::Set(d, kInfinity));
}

// Layers of matter over a texel. Returns s of the first point inside one, or infinity.
HWY_INLINE V HitBoxes(const TraceScene& scene, const Lanes& ray, const Segment& c) {
  const D d;
  const DI di;
  const V one = hn::Set(d, 1.0f);
  const VI stride = hn::Set(di, static_cast<std::int32_t>(scene.stride));
  const VI at = hn::Add(hn::Mul(hn::Sub(c.iy, hn::Set(di, scene.middle)), stride), c.ix);
  V first = hn::Set(d, kInfinity);
  for (const MatterLayer& layer : scene.layers) {
    const V front = Gather(layer.front, at), back = Gather(layer.back, at);
    const V top = scene.orthographic ? hn::Neg(front) : hn::Div(one, front);
    const V bottom = scene.orthographic ? hn::Neg(back) : hn::Div(one, back);
    const V hi = hn::Sub(top, ray.reference), lo = hn::Sub(bottom, ray.reference);
    const M inside = hn::And(hn::Lt(c.h0, hi), hn::Gt(c.h0, lo));
    const M through_front = hn::And(hn::Ge(c.h0, hi), hn::Lt(c.h1, hi));
    const M through_back = hn::And(hn::Le(c.h0, lo), hn::Gt(c.h1, lo));
    const V face = hn::IfThenElse(through_front, hi, lo);
    const V s = hn::Div(hn::Sub(face, ray.h), ray.gh);
    const V at_face = hn::Min(hn::Max(s, c.s0), c.s1);
    // Matter without extent blocks nothing.
    const M hit = hn::And(hn::Or(through_front, through_back), hn::Gt(hi, lo));
    const V layer_s =
        hn::IfThenElse(inside, c.s0, hn::IfThenElse(hit, at_face, hn::Set(d, kInfinity)));
    first = hn::Min(first, layer_s);
  }
  return first;
}

// Whether a block cannot block the ray between the two heights.
template <bool kBoxes>
HWY_INLINE M Passes(const TraceScene& scene, const Lanes& ray, const Segment& c, M active) {
  const DI di;
  const VI log_x = hn::Set(di, scene.log_x);
  const VI size = hn::Set(di, scene.log_x + scene.log_y);
  const VI block = hn::Add(hn::Shl(hn::Set(di, 1), hn::Sub(size, hn::Add(ray.level, ray.level))),
                           hn::Add(hn::Shl(c.iy, hn::Sub(log_x, ray.level)), c.ix));
  // Single cells are not in the pyramid.
  const VI at = hn::IfThenElseZero(hn::RebindMask(di, active), block);
  const V low = hn::Min(c.h0, c.h1), high = hn::Max(c.h0, c.h1);
  auto over = [&](const float* highest)
                  HWY_ATTR { return hn::Ge(low, hn::Sub(Gather(highest, at), ray.reference)); };
  if constexpr (!kBoxes) return over(scene.highest);
  M passes = active;
  for (const MatterLayer& layer : scene.layers) {
    const M under = hn::Le(high, hn::Sub(Gather(layer.lowest, at), ray.reference));
    passes = hn::And(passes, hn::Or(under, over(layer.highest)));
    if (hn::AllFalse(D(), passes)) break;
  }
  return passes;
}

// Gives every lane that is not in `alive` the next ray that has a way to go, and returns the lanes
// that have one. `ids` are the lanes' rays; `hits` what the ended ones found.
HWY_INLINE M Refill(const TraceScene& scene, RayBatch* batch, M alive, V hits, std::int32_t* ids,
                    int* next, Lanes* lanes) {
  const D d;
  const DI di;
  const int n = static_cast<int>(hn::Lanes(d));
  HWY_ALIGN float state[9][kMaxLanes];
  HWY_ALIGN float hit[kMaxLanes], on[kMaxLanes];
  HWY_ALIGN std::int32_t ix[kMaxLanes], iy[kMaxLanes], level[kMaxLanes];
  V* const fields[] = {&lanes->x,  &lanes->y,  &lanes->h,   &lanes->reference, &lanes->gx,
                       &lanes->gy, &lanes->gh, &lanes->end, &lanes->s};
  float* const source[] = {batch->x,  batch->y,  batch->h,  batch->reference,
                           batch->gx, batch->gy, batch->gh, batch->end};
  for (int k = 0; k < 9; ++k) hn::Store(*fields[k], d, state[k]);
  hn::Store(hits, d, hit);
  hn::Store(hn::IfThenElseZero(alive, hn::Set(d, 1.0f)), d, on);
  hn::Store(lanes->ix, di, ix);
  hn::Store(lanes->iy, di, iy);
  hn::Store(lanes->level, di, level);
  for (int lane = 0; lane < n; ++lane) {
    if (on[lane] != 0) continue;
    if (ids[lane] >= 0) batch->hit[ids[lane]] = hit[lane];
    ids[lane] = -1;
    while (*next < batch->count && !(batch->end[*next] > 0)) batch->hit[(*next)++] = kInfinity;
    if (*next == batch->count) continue;
    const int ray = (*next)++;
    ids[lane] = ray;
    on[lane] = 1;
    for (int k = 0; k < 8; ++k) state[k][lane] = source[k][ray];
    state[8][lane] = 0;
    level[lane] = 0;
    // From a cell's border, into the cell that the ray heads for.
    auto cell = [](float at, float g, int cells) {
      // Within the cells, for what an extreme camera makes of it may be no int.
      const float limited = std::min(std::max(0.0f, at), static_cast<float>(cells));
      const auto floor = static_cast<int>(limited);
      return std::clamp(floor - (g < 0 && static_cast<float>(floor) == at), 0, cells - 1);
    };
    ix[lane] = cell(batch->x[ray], batch->gx[ray], scene.cells_x);
    iy[lane] = cell(batch->y[ray], batch->gy[ray], scene.cells_y);
  }
  for (int k = 0; k < 9; ++k) *fields[k] = hn::Load(d, state[k]);
  lanes->ix = hn::Load(di, ix);
  lanes->iy = hn::Load(di, iy);
  lanes->level = hn::Load(di, level);
  const V one = hn::Set(d, 1.0f);
  lanes->per_gx = hn::Div(one, lanes->gx);
  lanes->per_gy = hn::Div(one, lanes->gy);
  auto step = [&](V g) HWY_ATTR {
    return hn::ConvertTo(di, hn::IfThenElseZero(hn::Gt(g, hn::Zero(d)), one));
  };
  lanes->step_x = step(lanes->gx);
  lanes->step_y = step(lanes->gy);
  return hn::Gt(hn::Load(d, on), hn::Zero(d));
}

template <bool kBoxes>
void Trace(const TraceScene& scene, RayBatch* batch) {
  const D d;
  const DI di;
  const auto n = hn::Lanes(d);
  const VI one = hn::Set(di, 1), zero = hn::Zero(di);
  const VI top_level = hn::Set(di, scene.top_level);
  const VI last_x = hn::Set(di, scene.cells_x - 1), last_y = hn::Set(di, scene.cells_y - 1);
  HWY_ALIGN std::int32_t ids[kMaxLanes];
  std::fill_n(ids, kMaxLanes, -1);
  Lanes ray;
  ray.x = ray.y = ray.h = ray.reference = ray.end = ray.s = hn::Zero(d);
  ray.gx = ray.gy = ray.gh = hn::Set(d, 1.0f);
  ray.ix = ray.iy = ray.level = zero;
  V hits = hn::Set(d, kInfinity);
  M alive = hn::Gt(hn::Zero(d), hn::Zero(d));
  int next = 0;
  for (;;) {
    const auto going = hn::CountTrue(d, alive);
    if (going == 0 || (next < batch->count && 4 * going <= 3 * n)) {
      alive = Refill(scene, batch, alive, hits, ids, &next, &ray);
      hits = hn::Set(d, kInfinity);
      if (hn::AllFalse(d, alive)) break;
    }
    // Where each lane leaves its block.
    const VI cx = hn::Shr(ray.ix, ray.level), cy = hn::Shr(ray.iy, ray.level);
    const VI bx = hn::Add(cx, ray.step_x), by = hn::Add(cy, ray.step_y);
    const VI border_x = hn::Shl(bx, ray.level), border_y = hn::Shl(by, ray.level);
    const V sx = hn::Mul(hn::Sub(hn::ConvertTo(d, border_x), ray.x), ray.per_gx);
    const V sy = hn::Mul(hn::Sub(hn::ConvertTo(d, border_y), ray.y), ray.per_gy);
    const V leave = hn::Max(hn::Min(sx, sy), ray.s);
    const V s1 = hn::Min(leave, ray.end);
    const Segment block{ray.s, s1, hn::MulAdd(ray.s, ray.gh, ray.h), hn::MulAdd(s1, ray.gh, ray.h),
                        cx,    cy};
    // Lanes at single cells wait until they are half of those alive.
    const M single = hn::And(alive, hn::RebindMask(d, hn::Eq(ray.level, zero)));
    M active, passes;
    if (2 * hn::CountTrue(d, single) >= hn::CountTrue(d, alive)) {
      active = single;
      const V s = kBoxes ? HitBoxes(scene, ray, block) : HitSurface(scene, ray, block);
      const M hit = hn::And(active, hn::Lt(s, hn::Set(d, kInfinity)));
      hits = hn::IfThenElse(hit, s, hits);
      alive = hn::AndNot(hit, alive);
      passes = hn::AndNot(hit, active);
    } else {
      active = hn::AndNot(single, alive);
      passes = hn::And(active, Passes<kBoxes>(scene, ray, block, active));
      const M looks = hn::AndNot(passes, active);
      ray.level = hn::IfThenElse(hn::RebindMask(di, looks), hn::Sub(ray.level, one), ray.level);
    }
    // On to the next block: across one border, the other coordinate from the ray, but kept inside
    // the old block against rounding.
    const M across_x = hn::Le(sx, sy);
    const VI last = hn::Sub(hn::Shl(one, ray.level), one);
    auto inside = [&](V at, VI c) HWY_ATTR {
      const VI low = hn::Shl(c, ray.level);
      return hn::Min(hn::Max(hn::ConvertTo(di, at), low), hn::Add(low, last));
    };
    const VI along_x = inside(hn::MulAdd(s1, ray.gx, ray.x), cx);
    const VI along_y = inside(hn::MulAdd(s1, ray.gy, ray.y), cy);
    const auto by_x = hn::RebindMask(di, across_x);
    const VI new_x = hn::IfThenElse(by_x, hn::Add(hn::Sub(border_x, one), ray.step_x), along_x);
    const VI new_y = hn::IfThenElse(by_x, along_y, hn::Add(hn::Sub(border_y, one), ray.step_y));
    const VI crossed = hn::IfThenElse(by_x, bx, by);
    // Into another block of the next level: it has not been looked at yet.
    const VI up = hn::Min(hn::Add(ray.level, hn::AndNot(crossed, one)), top_level);
    // The border that a ray leaves by is checked for, as rounding may take it across before `end`.
    const VI near_x = hn::Min(hn::Max(new_x, zero), last_x);
    const VI near_y = hn::Min(hn::Max(new_y, zero), last_y);
    const auto stays = hn::And(hn::Eq(near_x, new_x), hn::Eq(near_y, new_y));
    const M goes_on = hn::And(hn::Lt(leave, ray.end), hn::RebindMask(d, stays));
    alive = hn::AndNot(hn::AndNot(goes_on, passes), alive);
    passes = hn::And(passes, goes_on);
    const auto moved = hn::RebindMask(di, passes);
    ray.ix = hn::IfThenElse(moved, new_x, ray.ix);
    ray.iy = hn::IfThenElse(moved, new_y, ray.iy);
    ray.level = hn::IfThenElse(moved, up, ray.level);
    ray.s = hn::IfThenElse(passes, s1, ray.s);
  }
}

void TraceSurface(const TraceScene& scene, RayBatch* batch) { Trace<false>(scene, batch); }
void TraceBoxes(const TraceScene& scene, RayBatch* batch) { Trace<true>(scene, batch); }

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(TraceSurface);
HWY_EXPORT(TraceBoxes);

void trace_surface(const TraceScene& scene, RayBatch* batch) {
  HWY_DYNAMIC_DISPATCH(TraceSurface)(scene, batch);
}
void trace_boxes(const TraceScene& scene, RayBatch* batch) {
  HWY_DYNAMIC_DISPATCH(TraceBoxes)(scene, batch);
}

}  // namespace obscura
#endif
