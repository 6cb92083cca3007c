#ifndef OBSCURA_BENCH_TAP_BOUND_H_
#define OBSCURA_BENCH_TAP_BOUND_H_

#include <cstdint>
#include <functional>
#include <vector>

namespace obscura::bench {

// Lanes of the best SIMD target here.
int tap_lanes();

// Fills the taps of one image row, untimed: for each vector of tap_lanes() pixels, for each sample,
// the index of every lane's texel relative to `base`. A vector's lanes beyond the row repeat any
// valid index.
using RowTaps = std::function<void(int row, std::vector<std::int32_t>* index)>;

// Processor time of this thread: what other programs take of the machine does not count.
double thread_seconds();

// The least time that any method with these taps needs: median, over `runs`, of the
// thread_seconds() it takes to load each tap of each row once, lane by lane as the kernels do and
// with warm caches, on one thread.
double tap_bound_seconds(const float* base, int rows, int runs, const RowTaps& taps);

}  // namespace obscura::bench

#endif  // OBSCURA_BENCH_TAP_BOUND_H_
