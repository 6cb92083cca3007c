#ifndef OBSCURA_BENCH_BENCH_INPUT_H_
#define OBSCURA_BENCH_BENCH_INPUT_H_

#include "io/images/depth_input.h"

namespace obscura::bench {

// The input of the benchmarks of screen-space methods, without a guard band.
tools::DepthInput bench_input(int width, int height);

}  // namespace obscura::bench

#endif  // OBSCURA_BENCH_BENCH_INPUT_H_
