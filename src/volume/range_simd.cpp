#include <algorithm>
#include <cmath>

#include "volume/range_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/range_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void AddRow(const float* HWY_RESTRICT row, int width, PlaneRange* range) {
  const hn::ScalableTag<float> d;
  const hn::ScalableTag<double> dd;
  const hn::Half<decltype(d)> dh;
  const int lanes = static_cast<int>(hn::Lanes(d));
  constexpr float kLargest = std::numeric_limits<float>::max();
  const auto largest = hn::Set(d, kLargest);
  auto low = hn::Set(d, range->min), high = hn::Set(d, range->max);
  auto sum = hn::Zero(dd), more = sum;
  std::int64_t finite = 0;
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto v = hn::LoadU(d, row + x);
    const auto in = hn::Le(hn::Abs(v), largest);
    low = hn::Min(low, hn::IfThenElse(in, v, low));
    high = hn::Max(high, hn::IfThenElse(in, v, high));
    const auto counted = hn::IfThenElseZero(in, v);
    sum = hn::Add(sum, hn::PromoteTo(dd, hn::LowerHalf(dh, counted)));
    more = hn::Add(more, hn::PromoteTo(dd, hn::UpperHalf(dh, counted)));
    finite += static_cast<std::int64_t>(hn::CountTrue(d, in));
  }
  range->min = hn::GetLane(hn::MinOfLanes(d, low));
  range->max = hn::GetLane(hn::MaxOfLanes(d, high));
  range->sum += hn::GetLane(hn::SumOfLanes(dd, hn::Add(sum, more)));
  for (; x < width; ++x) {
    if (!(std::fabs(row[x]) <= kLargest)) continue;
    range->min = std::min(range->min, row[x]);
    range->max = std::max(range->max, row[x]);
    range->sum += row[x];
    ++finite;
  }
  range->finite += finite;
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(AddRow);

void add_row_to_range(const float* row, int width, PlaneRange* range) {
  HWY_DYNAMIC_DISPATCH(AddRow)(row, width, range);
}

}  // namespace obscura
#endif
