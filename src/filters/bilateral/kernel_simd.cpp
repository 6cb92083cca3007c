#include <limits>

#include "filters/bilateral/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filters/bilateral/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "filters/edge_leaf.h"
}  // namespace leaf

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

HWY_INLINE hn::Mask<D> IsSurface(V s) {
  const D d;
  const V inf = hn::Set(d, std::numeric_limits<float>::infinity());
  return hn::And(hn::Gt(s, hn::Zero(d)), hn::Lt(s, inf));
}

void SurfaceRow(const float* HWY_RESTRICT depth, int width, bool orthographic,
                float* HWY_RESTRICT surface) {
  const D d;
  const V one = hn::Set(d, 1.0f);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < width; x += lanes) {
    const V z = hn::LoadU(d, depth + x);
    hn::StoreU(orthographic ? z : hn::Div(one, z), d, surface + x);
  }
}

void BilateralPixels(const BilateralRow& row, int width, float* HWY_RESTRICT out) {
  const D d;
  const V zero = hn::Zero(d);
  const V inf = hn::Set(d, std::numeric_limits<float>::infinity());
  const int lanes = static_cast<int>(hn::Lanes(d));
  const bool has_before = row.first_tap<0, has_after = row.last_tap> 0;
  for (int x = 0; x < width; x += lanes) {
    const float* values = row.values + x;
    const float* surface = row.surface + x;
    const V v0 = hn::LoadU(d, values), s0 = hn::LoadU(d, surface);
    auto difference = [&](bool inside, std::ptrdiff_t step, float sign) HWY_ATTR {
      if (!inside) return inf;
      const V s = hn::LoadU(d, surface + step);
      return hn::IfThenElse(IsSurface(s), hn::Mul(hn::Sub(s, s0), hn::Set(d, sign)), inf);
    };
    const V after = difference(has_after, row.surface_step, 1.0f);
    const V before = difference(has_before, -row.surface_step, -1.0f);
    const V slope = leaf::surface_slope(after, before);
    const V per_edge = leaf::edges_per_unit(s0, hn::Set(d, 1 / row.edge), row.orthographic);

    V sum = zero, weight_sum = hn::Set(d, leaf::kBinomial[0]);
    for (int k = row.first_tap; k <= row.last_tap; ++k) {
      if (k == 0) continue;
      const V v = hn::LoadU(d, values + k * row.value_step);
      const V s = hn::LoadU(d, surface + k * row.surface_step);
      const V gap = leaf::gap_to_surface(s, s0, slope, hn::Set(d, static_cast<float>(k)), per_edge);
      const V weight = hn::Mul(leaf::edge_weight(gap), hn::Set(d, leaf::kBinomial[k < 0 ? -k : k]));
      const V w = hn::IfThenElseZero(IsSurface(s), weight);
      sum = hn::MulAdd(w, hn::Sub(v, v0), sum);
      weight_sum = hn::Add(weight_sum, w);
    }
    hn::StoreU(hn::Add(v0, hn::Div(sum, weight_sum)), d, out + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(SurfaceRow);
HWY_EXPORT(BilateralPixels);

void surface_row(const float* depth, int width, bool orthographic, float* surface) {
  HWY_DYNAMIC_DISPATCH(SurfaceRow)(depth, width, orthographic, surface);
}
void bilateral_row(const BilateralRow& row, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(BilateralPixels)(row, width, out);
}

}  // namespace obscura
#endif
