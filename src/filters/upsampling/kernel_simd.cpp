#include <limits>

#include "filters/upsampling/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filters/upsampling/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "filters/edge_leaf.h"
// After edge_leaf.h.
#include "filters/upsampling/upsampling_leaf.h"
}  // namespace leaf

namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE M IsSurface(V s) {
  const D d;
  return hn::And(hn::Gt(s, hn::Zero(d)), hn::Lt(s, hn::Inf(d)));
}

HWY_INLINE V Alike(const UpsamplingRow& row, int x, std::ptrdiff_t step) {
  const D d;
  V cosine = hn::Zero(d);
  for (const float* normal : row.normal) {
    cosine = hn::MulAdd(hn::LoadU(d, normal + x), hn::LoadU(d, normal + x + step), cosine);
  }
  return leaf::likeness(cosine);
}

void Upsample(const UpsamplingRow& row, int width) {
  const D d;
  const V zero = hn::Zero(d);
  const M odd = hn::Gt(hn::Mul(hn::Iota(d, 0), hn::Set(d, 0.5f)),
                       hn::Floor(hn::Mul(hn::Iota(d, 0), hn::Set(d, 0.5f))));
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const float* surface = row.surface + x;
    const V s0 = hn::LoadU(d, surface);
    auto at = [&](bool there, std::ptrdiff_t step)
                  HWY_ATTR { return there ? hn::LoadU(d, surface + step) : zero; };
    const V before = at(row.before, -row.surface_step), after = at(row.after, row.surface_step);
    const M has_before = IsSurface(before), has_after = IsSurface(after);
    const leaf::SideWeights sides = leaf::side_weights(s0, before, after, has_before, has_after,
                                                       hn::Set(d, row.edge), row.orthographic);
    V w_before = sides.before, w_after = sides.after;
    if (row.normal[0]) {
      if (row.before) w_before = hn::Mul(w_before, Alike(row, x, -row.normal_step));
      if (row.after) w_after = hn::Mul(w_after, Alike(row, x, row.normal_step));
    }
    const V share = hn::Div(w_after, hn::Add(w_before, w_after));
    const M from_before = hn::Gt(w_before, zero), from_after = hn::Gt(w_after, zero);
    for (int c = 0; c < row.channels; ++c) {
      const float* values = row.values[c] + x;
      const V a = row.before ? hn::LoadU(d, values - row.value_step) : zero;
      const V b = row.after ? hn::LoadU(d, values + row.value_step) : zero;
      // What does not count need not be a number.
      const V mixed = hn::MulAdd(share, hn::Sub(b, a), a);
      V v = hn::IfThenElse(from_before, hn::IfThenElse(from_after, mixed, a), b);
      v = hn::IfThenElse(hn::Or(has_before, has_after), v, hn::Set(d, row.open[c]));
      if (row.odd_only) v = hn::IfThenElse(odd, v, hn::LoadU(d, values));
      hn::StoreU(v, d, row.out[c] + x);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
namespace {
HWY_EXPORT(Upsample);
}  // namespace

void upsample_row(const UpsamplingRow& row, int width) {
  HWY_DYNAMIC_DISPATCH(Upsample)(row, width);
}

}  // namespace obscura
#endif
