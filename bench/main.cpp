// obscura-bench: Google Benchmark, with its own flags.
#include <benchmark/benchmark.h>

#include <cstdio>

#include "obscura/simd.h"

int main(int argc, char** argv) {
  if (const obscura::Status s = obscura::limit_simd_from_environment(); !s.ok()) {
    std::fprintf(stderr, "obscura-bench: %s\n", s.message().c_str());
    return 2;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
