#include "screen/area/moments_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/area/moments_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void MergeMoments(const MomentRow rows[5], int width, float* HWY_RESTRICT share,
                  float* HWY_RESTRICT mean, float* HWY_RESTRICT variance) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  constexpr float kWeights[5] = {1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};
  const V zero = hn::Zero(d);
  const V farthest = hn::Set(d, 1e18f);  // so that squares stay finite
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < width; x += lanes) {
    V w[5], m[5];
    V sum = zero, first = zero;
    for (int k = 0; k < 5; ++k) {
      w[k] = hn::Mul(hn::Set(d, kWeights[k]), hn::LoadU(d, rows[k].share + x));
      m[k] = hn::LoadU(d, rows[k].mean + x);
      sum = hn::Add(sum, w[k]);
    }
    const auto any = hn::Gt(sum, zero);
    const V per_sum = hn::IfThenElseZero(any, hn::Div(hn::Set(d, 1.0f), sum));
    // Relative to the middle row's mean, which is near the result, so that little is rounded.
    for (int k = 0; k < 5; ++k) first = hn::MulAdd(w[k], hn::Sub(m[k], m[2]), first);
    const V average = hn::IfThenElseZero(any, hn::MulAdd(first, per_sum, m[2]));
    V second = zero;
    for (int k = 0; k < 5; ++k) {
      const V off = hn::Max(hn::Min(hn::Sub(m[k], average), farthest), hn::Neg(farthest));
      second = hn::MulAdd(w[k], hn::MulAdd(off, off, hn::LoadU(d, rows[k].variance + x)), second);
    }
    hn::StoreU(sum, d, share + x);
    hn::StoreU(average, d, mean + x);
    hn::StoreU(hn::Mul(second, per_sum), d, variance + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(MergeMoments);

void merge_moments(const MomentRow rows[5], int width, float* share, float* mean, float* variance) {
  HWY_DYNAMIC_DISPATCH(MergeMoments)(rows, width, share, mean, variance);
}

}  // namespace obscura
#endif
