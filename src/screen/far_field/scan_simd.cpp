#include <limits>

#include "screen/far_field/scan_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/scan_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

void ScanStrip(const StripJob& job) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), slope = hn::Set(d, job.slope);
  const V inf = hn::Set(d, std::numeric_limits<float>::infinity());
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    V nearest = inf, slanted = hn::Neg(inf);
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      const V a = hn::LoadU(d, row.lattice + j + row.offset);
      const V b = hn::LoadU(d, row.lattice + j + row.offset + 1);
      const V blend = hn::Set(d, row.blend);
      // Beside the background the nearer texel decides: a skirt that falls to infinity within one
      // cell would spoil the averages.
      const V single = row.blend < 0.5f ? a : b;
      const auto both = hn::Gt(hn::Min(a, b), zero);
      const V g = hn::IfThenElse(both, hn::MulAdd(blend, hn::Sub(b, a), a), single);
      const auto surface = hn::Gt(g, zero);
      const V depth = job.orthographic ? hn::Sub(hn::Set(d, job.kappa), g) : hn::Div(one, g);
      const V outward = hn::Mul(hn::Set(d, row.outward), job.orthographic ? one : depth);
      const V height = hn::MulSub(slope, outward, depth);
      nearest = hn::Min(nearest, hn::IfThenElse(surface, depth, inf));
      slanted = hn::Max(slanted, hn::IfThenElse(surface, height, hn::Neg(inf)));
    }
    hn::Store(nearest, d, job.nearest + j);
    hn::Store(slanted, d, job.slanted + j);
  }
}

void MergeStrips(int lines, const float* near_a, const float* slant_a, const float* near_b,
                 const float* slant_b, float* nearest, float* slanted) {
  const D d;
  for (int j = 0; j < lines; j += static_cast<int>(hn::Lanes(d))) {
    hn::Store(hn::Min(hn::Load(d, near_a + j), hn::Load(d, near_b + j)), d, nearest + j);
    hn::Store(hn::Max(hn::Load(d, slant_a + j), hn::Load(d, slant_b + j)), d, slanted + j);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(ScanStrip);
HWY_EXPORT(MergeStrips);

void scan_strip(const StripJob& job) { HWY_DYNAMIC_DISPATCH(ScanStrip)(job); }

void merge_strips(int lines, const float* near_a, const float* slant_a, const float* near_b,
                  const float* slant_b, float* nearest, float* slanted) {
  HWY_DYNAMIC_DISPATCH(MergeStrips)(lines, near_a, slant_a, near_b, slant_b, nearest, slanted);
}

// A running sum is a chain of additions, which lanes would not shorten.
void sum_lines(int lines, float slope, const float* nearest, const float* slanted,
               const PrefixSums& sums) {
  constexpr int kPad = PrefixSums::kPadding;
  double depth = 0, outward = 0;
  float count = 0;
  auto set = [&](int j) {
    sums.depth[j] = depth;
    sums.outward[j] = outward;
    sums.count[j] = count;
  };
  for (int j = -kPad; j < 0; ++j) set(j);
  for (int j = 0; j < lines; ++j) {
    set(j);
    const bool surface = nearest[j] < std::numeric_limits<float>::infinity();
    depth += surface ? nearest[j] : 0.0f;
    // The two receiver lines meet where z = m0 and slope x = m1 - m0.
    outward += surface ? slope * (slanted[j] + nearest[j]) : 0.0f;
    count += surface ? 1.0f : 0.0f;
  }
  for (int j = lines; j < lines + 2 * kPad; ++j) set(j);
}

}  // namespace obscura::far_field
#endif
