#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/bench_input.h"
#include "obscura/estimator.h"

namespace obscura::bench {
namespace {

// Whole estimator, with and without the blur; every value is checked before it is timed.
void horizon_run(benchmark::State& state) {
  const int width = 1280, height = 720;
  const tools::DepthInput input = bench_input(width, height);
  HorizonSettings settings;
  settings.variant = state.range(0) ? HorizonVariant::kClassic : HorizonVariant::kSlices;
  settings.falloff.kind = state.range(1) ? FalloffKind::kConstant : FalloffKind::kExponential;
  settings.falloff.radius = static_cast<float>(0.025 * input.scene_size);
  settings.directions = settings.steps = 8;
  settings.occluder = state.range(4) ? Occluder::automatic() : Occluder::solid();
  settings.blur = state.range(2) != 0;
  const DepthField field = input.field();
  std::vector<float> result(static_cast<std::size_t>(width) * height);
  Outputs outputs;
  outputs.visibility = {result.data(), width, height};
  Estimator estimator;
  const RunOptions options{.threads = static_cast<int>(state.range(3))};
  if (!Estimator::create(settings, width, height, &estimator).ok() ||
      !estimator.run(field, outputs, options).ok()) {
    return state.SkipWithError("the input was refused");
  }
  for (float v : result) {
    if (!(v >= 0 && v <= 1)) return state.SkipWithError("the result is wrong");
  }
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    if (!estimator.run(field, outputs, options).ok()) return state.SkipWithError("the run failed");
    times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  const double median = times[times.size() / 2];
  state.counters["median_ms"] = median * 1e3;
  state.counters["ns/tap"] =
      median * 1e9 / width / height / settings.directions / settings.steps * state.range(3);
}
BENCHMARK(horizon_run)
    ->Name("horizon")
    ->ArgNames({"classic", "constant", "blur", "threads", "auto"})
    ->Args({0, 0, 0, 1, 0})
    ->Args({0, 1, 0, 1, 0})
    ->Args({1, 1, 0, 1, 0})
    ->Args({0, 0, 0, 2, 0})
    ->Args({0, 0, 1, 2, 0})
    ->Args({0, 0, 0, 1, 1})
    ->Args({0, 1, 0, 1, 1})
    ->Args({0, 0, 1, 2, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace obscura::bench
