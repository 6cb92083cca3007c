#ifndef OBSCURA_BENCH_RUN_BENCHMARKS_H_
#define OBSCURA_BENCH_RUN_BENCHMARKS_H_

namespace obscura::bench {

// Runs the Google Benchmarks that are linked in, with Google Benchmark's own flags in argv.
int run(int argc, char** argv);

}  // namespace obscura::bench

#endif  // OBSCURA_BENCH_RUN_BENCHMARKS_H_
