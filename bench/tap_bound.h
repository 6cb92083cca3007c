#ifndef OBSCURA_BENCH_TAP_BOUND_H_
#define OBSCURA_BENCH_TAP_BOUND_H_

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace obscura::bench {

// Lanes of the best SIMD target here.
int tap_lanes();

// Fills the taps of one image row, untimed: for each vector of tap_lanes() pixels, for each sample,
// the index of every lane's texel relative to `base`. A vector's lanes beyond the row repeat any
// valid index.
using RowTaps = std::function<void(int row, std::vector<std::int32_t>* index)>;

// CPU time of this thread, so that other programs on the machine do not count.
double thread_seconds();

// The fastest of `runs` calls after one that is not timed, in thread_seconds() less what reading
// the clock takes.
template <class F>
double fastest_seconds(int runs, F f) {
  f();
  double fastest = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = thread_seconds();
    f();
    const double middle = thread_seconds();
    fastest = std::min(fastest, (middle - start) - (thread_seconds() - middle));
  }
  return fastest;
}

// The tap bound: the least time that any method with these taps needs. It loads each tap of rows
// [begin, end) once, lane by lane as the kernels do, with warm caches, on one thread, in
// thread_seconds(). The fastest of `runs` counts for each row, since other programs can only make
// it slower.
double tap_bound_seconds(const float* base, int begin, int end, int runs, const RowTaps& taps);

}  // namespace obscura::bench

#endif  // OBSCURA_BENCH_TAP_BOUND_H_
