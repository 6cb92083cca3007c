#include "screen/volumetric/area/moments_kernel.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/volumetric/area/moments_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "math/apart_leaf.h"
// After apart_leaf.h.
#include "screen/volumetric/area/moments_leaf.h"
}  // namespace leaf

namespace hn = hwy::HWY_NAMESPACE;

void MergeMoments(const MomentRow rows[5], int width, float slack, float* HWY_RESTRICT share,
                  float* HWY_RESTRICT mean, float* HWY_RESTRICT variance) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const V zero = hn::Zero(d);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < width; x += lanes) {
    V w[5], m[5], v[5];
    V sum = zero;
    for (int k = 0; k < 5; ++k) {
      w[k] = hn::Mul(hn::Set(d, leaf::kMomentWeights[k]), hn::LoadU(d, rows[k].share + x));
      m[k] = hn::LoadU(d, rows[k].mean + x);
      v[k] = hn::LoadU(d, rows[k].variance + x);
    }
    const V nearest = leaf::nearest_mean(w, m, hn::Set(d, slack));
    for (int k = 0; k < 5; ++k) {
      w[k] = leaf::weight_beside(nearest, w[k], m[k]);
      m[k] = leaf::mean_beside(nearest, m[k]);
      sum = hn::Add(sum, w[k]);
    }
    const auto any = hn::Gt(sum, zero);
    const V per_sum = hn::IfThenElseZero(any, hn::Div(hn::Set(d, 1.0f), sum));
    const V average = hn::IfThenElseZero(any, leaf::merged_mean(w, m, per_sum));
    const V second = leaf::merged_variance(w, m, v, average);
    hn::StoreU(sum, d, share + x);
    hn::StoreU(average, d, mean + x);
    hn::StoreU(hn::Mul(second, per_sum), d, variance + x);
  }
}

void PackMoments(const MomentRow& now, const MomentRow& next, int width, float slack,
                 MomentTexel* HWY_RESTRICT out) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  using V = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = 0; x < width; x += lanes) {
    const V share1 = hn::LoadU(d, next.share + x);
    const V mean1 = hn::LoadU(d, next.mean + x), variance1 = hn::LoadU(d, next.variance + x);
    const V own = hn::LoadU(d, now.mean + x);
    const auto any =
        leaf::stands_beside(hn::LoadU(d, now.share + x), own, mean1, hn::Set(d, slack));
    const V share0 = hn::IfThenElseZero(any, hn::LoadU(d, now.share + x));
    const V mean0 = hn::IfThenElse(any, own, mean1);
    const V variance0 = hn::IfThenElse(any, hn::LoadU(d, now.variance + x), variance1);
    auto bits = [&](V variance, V share) HWY_ATTR {
      const auto part = hn::NearestInt(hn::Mul(share, hn::Set(d, 255.0f)));
      const auto deviation = hn::BitCast(di, hn::Sqrt(variance));
      return hn::BitCast(d, hn::Or(hn::AndNot(hn::Set(di, 255), deviation), part));
    };
    const V bits0 = bits(variance0, share0), bits1 = bits(variance1, share1);
    if (width - x >= lanes) {
      hn::StoreInterleaved4(mean0, mean1, bits0, bits1, d, reinterpret_cast<float*>(out + x));
      continue;
    }
    HWY_ALIGN float last[4 * HWY_MAX_BYTES / sizeof(float)];
    hn::StoreInterleaved4(mean0, mean1, bits0, bits1, d, last);
    std::memcpy(out + x, last, (width - x) * sizeof(MomentTexel));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(MergeMoments);
HWY_EXPORT(PackMoments);

void merge_moments(const MomentRow rows[5], int width, float slack, float* share, float* mean,
                   float* variance) {
  HWY_DYNAMIC_DISPATCH(MergeMoments)(rows, width, slack, share, mean, variance);
}
void pack_moments(const MomentRow& now, const MomentRow& next, int width, float slack,
                  MomentTexel* out) {
  HWY_DYNAMIC_DISPATCH(PackMoments)(now, next, width, slack, out);
}

}  // namespace obscura
#endif
