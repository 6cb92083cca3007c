#include "bench/tap_bound.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/tap_bound.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using obscura::HWY_NAMESPACE::GatherLanes;

int Lanes() { return static_cast<int>(hn::Lanes(hn::ScalableTag<float>())); }

// Four sums, so that no addition waits for the one before.
float LoadTaps(const float* base, const std::int32_t* index, std::size_t count) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  auto s0 = hn::Zero(d), s1 = s0, s2 = s0, s3 = s0;
  std::size_t i = 0;
  for (; i + 4 * lanes <= count; i += 4 * lanes) {
    s0 = hn::Add(s0, GatherLanes(d, base, index + i));
    s1 = hn::Add(s1, GatherLanes(d, base, index + i + lanes));
    s2 = hn::Add(s2, GatherLanes(d, base, index + i + 2 * lanes));
    s3 = hn::Add(s3, GatherLanes(d, base, index + i + 3 * lanes));
  }
  for (; i < count; i += lanes) s0 = hn::Add(s0, GatherLanes(d, base, index + i));
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(s0, s1), hn::Add(s2, s3))));
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>

namespace obscura::bench {

HWY_EXPORT(Lanes);
HWY_EXPORT(LoadTaps);

int tap_lanes() { return HWY_DYNAMIC_DISPATCH(Lanes)(); }

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double tap_bound_seconds(const float* base, int begin, int end, int runs, const RowTaps& taps) {
  std::vector<std::int32_t> index;
  double total = 0;
  for (int row = begin; row < end; ++row) {
    index.clear();
    taps(row, &index);
    // Making the indices has evicted from the caches what a kernel would find there from the row
    // before. A first pass, not timed, loads it again.
    total += fastest_seconds(runs, [&] {
      benchmark::DoNotOptimize(HWY_DYNAMIC_DISPATCH(LoadTaps)(base, index.data(), index.size()));
    });
  }
  return total;
}

}  // namespace obscura::bench
#endif
