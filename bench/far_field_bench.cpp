#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/bench_input.h"
#include "obscura/estimator.h"
#include "screen/far_field/directions.h"
#include "screen/far_field/plane.h"
#include "screen/far_field/scan.h"

namespace obscura::bench {
namespace {

// The bench's scene with 10 % of it as guard band.
tools::DepthInput guarded(int width, int height) {
  const GuardBand guard = GuardBand::symmetric(width / 10, height / 10);
  tools::DepthInput input = bench_input(width + 2 * guard.left, height + 2 * guard.top);
  input.guard_band = guard;
  return input;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Whole estimator: K = 8x2 with or without the near field.
void far_field_run(benchmark::State& state) {
  const int height = static_cast<int>(state.range(0)), width = height * 16 / 9;
  const tools::DepthInput input = guarded(width, height);
  FarFieldSettings settings{.occluder = Occluder::solid()};
  settings.directions = 8;
  settings.near_field = state.range(1) != 0;
  settings.near_step = NearStep::of(1);
  settings.falloff.radius = static_cast<float>(state.range(3)) * 0.1f;
  Estimator estimator;
  const DepthField field = input.field();
  const int threads = static_cast<int>(state.range(2));
  std::vector<float> result(static_cast<std::size_t>(width) * height);
  Outputs outputs;
  outputs.visibility = {result.data(), width, height};
  const RunOptions options{.threads = threads};
  if (!Estimator::create(settings, field.depth.width, field.depth.height, &estimator).ok() ||
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
    times.push_back(seconds_since(start));
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  state.counters["median_ms"] = times[times.size() / 2] * 1e3;
  state.counters["ns/px"] = times[times.size() / 2] * 1e9 / width / height;
}
BENCHMARK(far_field_run)
    ->Name("far_field")
    ->ArgNames({"height", "near", "threads", "radius/0.1"})
    ->Args({720, 0, 2, 10})
    ->Args({720, 0, 1, 10})
    ->Args({720, 1, 2, 10})
    ->Args({720, 0, 2, 1})
    ->Args({720, 0, 2, 10000})
    ->Args({2160, 0, 2, 10})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// The default K = 16x2 without and with directions, measured alternately.
void far_field_direction(benchmark::State& state) {
  const int height = static_cast<int>(state.range(0)), width = height * 16 / 9;
  const tools::DepthInput input = guarded(width, height);
  FarFieldSettings settings{.occluder = Occluder::solid()};
  settings.falloff.radius = 1;
  Estimator estimator;
  const DepthField field = input.field();
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  std::vector<float> planes[5];
  for (auto& plane : planes) plane.resize(pixels);
  auto view = [&](int i) { return ImageView<float>{planes[i].data(), width, height}; };
  Outputs plain, directed;
  plain.visibility = directed.visibility = view(0);
  directed.bent_normal = {view(1), view(2), view(3)};
  directed.cone_angle = view(4);
  const RunOptions options{.threads = 1};
  if (!Estimator::create(settings, field.depth.width, field.depth.height, &estimator).ok() ||
      !estimator.run(field, directed, options).ok()) {
    return state.SkipWithError("the input was refused");
  }
  double without = 1e9, with = 1e9;
  for (auto _ : state) {
    auto start = std::chrono::steady_clock::now();
    if (!estimator.run(field, plain, options).ok()) return state.SkipWithError("the run failed");
    without = std::min(without, seconds_since(start));
    start = std::chrono::steady_clock::now();
    if (!estimator.run(field, directed, options).ok()) return state.SkipWithError("the run failed");
    with = std::min(with, seconds_since(start));
  }
  state.counters["without_ms"] = without * 1e3;
  state.counters["with_ms"] = with * 1e3;
  state.counters["overhead_%"] = (with / without - 1) * 100;
}
BENCHMARK(far_field_direction)
    ->ArgName("height")
    ->Arg(720)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// The first two passes, and the bytes of intermediate data.
void far_field_scan(benchmark::State& state) {
  const int width = 1280, height = 720, interval = 10;
  const tools::DepthInput input = guarded(width, height);
  const auto executor = make_executor(static_cast<int>(state.range(0)));
  view::Geometry geometry;
  if (!view::convert(input.field(), {.normals = true, .works_without_normals = true}, *executor,
                     &geometry)
           .ok()) {
    return state.SkipWithError("the input was refused");
  }
  FarFieldSettings settings{.occluder = Occluder::solid()};
  settings.directions = 8;
  const auto directions = far_field::make_directions(settings);
  const int margin = far_field::sideways_reach(directions, interval) + 32;
  far_field::Plane planes[2];
  for (int i = 0; i < 2; ++i) {
    far_field::fill_plane(geometry, settings.occluder, i == 1, margin, 1, *executor, &planes[i]);
  }
  far_field::ScanBuffer buffer;
  std::size_t largest = 0, all = 0;
  for (auto _ : state) {
    all = 0;
    for (const far_field::Direction& d : directions) {
      far_field::scan(planes[d.transposed], d, {interval, -1, 1}, *executor, &buffer);
      far_field::sum(planes[d.transposed], d, {interval, -1}, *executor, &buffer);
      largest = std::max(largest, buffer.bytes());
      all += buffer.bytes();
    }
  }
  state.counters["MB_one_direction"] = static_cast<double>(largest) * 1e-6;
  state.counters["MB_all_directions"] = static_cast<double>(all) * 1e-6;
}
BENCHMARK(far_field_scan)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace obscura::bench
