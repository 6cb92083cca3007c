#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <vector>

#include "obscura/terrain.h"
#include "tests/reference/terrain.h"

// Sky-view factors of mountains, checked against marched horizons before they are timed. Beside the
// rate stands its bound: that of adding one number per cell, azimuth and quantity in memory.
namespace obscura::bench {
namespace {

double wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Seconds per cell of a[i] += b[i] on one thread, the best of several.
double read_modify_write() {
  std::vector<float> a(std::size_t{1} << 25, 1.0f), b(a.size(), 2.0f);
  double best = 1e9;
  for (int run = 0; run < 5; ++run) {
    const double start = wall();
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
    best = std::min(best, wall() - start);
  }
  return best / double(a.size());
}

// Mean error of the two sky-view factors on a small model, in percent.
bool is_right(int azimuths) {
  const reference::Model m = reference::mountains(160, 160, 30, 600);
  std::vector<float> svf(m.heights.size()), normal(svf);
  TerrainSettings settings;
  settings.azimuths = azimuths;
  TerrainOutputs outputs;
  outputs.svf = {svf.data(), m.width, m.height};
  outputs.svf_normal = {normal.data(), m.width, m.height};
  if (!compute_terrain(m.view(), settings, outputs).ok()) return false;
  double error = 0, sum = 0;
  for (int y = 10; y < 160; y += 37) {
    for (int x = 10; x < 160; x += 37) {
      const reference::Seen truth = reference::marched(m, x, y, 720);
      const std::size_t i = std::size_t(y) * 160 + x;
      error += std::fabs(svf[i] - truth.svf) + std::fabs(normal[i] - truth.svf_normal);
      sum += truth.svf + truth.svf_normal;
    }
  }
  return error / sum < 0.004;
}

void terrain(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0)), azimuths = static_cast<int>(state.range(1));
  const int threads = static_cast<int>(state.range(2));
  if (!is_right(azimuths)) return state.SkipWithError("the result is wrong");
  const double bound = read_modify_write();
  const reference::Model m = reference::mountains(side, side, 30, 600);
  std::vector<float> svf(m.heights.size()), normal(svf);
  TerrainSettings settings;
  settings.azimuths = azimuths;
  TerrainOutputs outputs;
  outputs.svf = {svf.data(), side, side};
  outputs.svf_normal = {normal.data(), side, side};
  RunOptions run;
  run.threads = threads;
  std::vector<double> processor, times;
  for (auto _ : state) {
    const std::clock_t clock = std::clock();
    const double start = wall();
    if (!compute_terrain(m.view(), settings, outputs, run).ok()) {
      return state.SkipWithError("refused");
    }
    times.push_back(wall() - start);
    processor.push_back(double(std::clock() - clock) / CLOCKS_PER_SEC);
    state.SetIterationTime(times.back());
  }
  const double cells = double(side) * side;
  std::ranges::sort(times);
  std::ranges::sort(processor);
  state.counters["Mcells/s"] = 1e-6 * cells / times[times.size() / 2];
  state.counters["bound_Mcells/s"] = 1e-6 * threads / (2 * azimuths * bound);
  state.counters["cpu_ns/cell/azimuth"] = 1e9 * processor[processor.size() / 2] / cells / azimuths;
}
BENCHMARK(terrain)
    ->Name("terrain_svf_and_svf_normal")
    ->ArgNames({"side", "azimuths", "threads"})
    ->Args({1000, 16, 1})
    ->Args({4000, 16, 1})
    ->Args({4000, 16, 2})
    ->Args({4000, 64, 2})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obscura::bench
