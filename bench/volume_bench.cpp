#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/volumes/vdb.h"
#include "obscura/volume.h"
#include "scene/volumes/vdb_distance.h"
#include "tests/reference/volume_loops.h"
#include "volume/distance_pass.h"
#include "volume/distance_start.h"
#include "volume/occlusion_kernel.h"
#include "volume/transport.h"

// Sweeps of a gyroid, each checked against plain loops on the same grid before it is timed, with
// those loops' time beside it.
namespace obscura::bench {
namespace {

constexpr int kLoopSide = 128;  // plain loops cost the same per voxel at any size

class Gyroid {
 public:
  explicit Gyroid(int n) : size{n, n, n}, values(std::size_t(n) * n * n), distance(values.size()) {
    const float s = 4 * 3.14159265f / float(n);
    std::size_t i = 0;
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          const float a = s * float(x), b = s * float(y), c = s * float(z);
          values[i++] =
              (std::sin(a) * std::cos(b) + std::sin(b) * std::cos(c) + std::sin(c) * std::cos(a)) /
              (1.5f * s);
        }
      }
    }
  }
  VolumeView view() const {
    VolumeView v;
    v.data = values.data();
    v.size = size;
    return v;
  }
  GridView<float> grid() { return {distance.data(), size, {1, 1, 1}}; }
  double voxels() const { return double(values.size()); }

  std::array<int, 3> size;
  std::vector<float> values, distance;
};

// CPU time stays comparable on a busy machine; with one thread it equals the wall-clock time of an
// idle machine.
struct Seconds {
  double wall = 0, processor = 0;
};
Seconds seconds_of(const std::function<void()>& f) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t clock = std::clock();
  f();
  const double processor = double(std::clock() - clock) / CLOCKS_PER_SEC;
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          processor};
}

// `loops`: nanoseconds of processor time per voxel of the plain loops, or 0.
void report(benchmark::State& state, std::vector<Seconds> times, double voxels, double loops) {
  auto median = [&](double Seconds::*part) {
    const auto middle = times.begin() + std::ptrdiff_t(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end(),
                     [&](const Seconds& a, const Seconds& b) { return a.*part < b.*part; });
    return (*middle).*part * 1e9 / voxels;
  };
  const double processor = median(&Seconds::processor);
  state.counters["ns/voxel"] = median(&Seconds::wall);
  state.counters["cpu_ns/voxel"] = processor;
  if (loops > 0) state.counters["times_loops"] = loops / processor;
}

// The eight sweeps, without the start.
void sweep_eight(Gyroid& g, DistanceStage& first, DistanceStage& second, Executor& executor) {
  const std::function<bool(double)> silent;
  Progress progress(1, silent);
  for (const bool rising : {true, false}) {
    first.begin_pass();
    second.begin_pass();
    (void)sweep_distance_pass(g.grid(), rising, first, second, executor, executor.thread_count(),
                              progress);
  }
}

// Largest difference between the loops' distances and ours, and the loops' ns per voxel.
double distance_loops(double* difference) {
  Gyroid g(kLoopSide);
  auto executor = make_executor(1);
  DistanceSettings settings;
  settings.solid = SolidSide::kBelow;
  start_distance(g.view(), 0, settings, g.grid(), *executor);
  const int n = kLoopSide, p = n + 2;
  std::vector<float> loops(std::size_t(p) * p * p, 1e10f);
  auto at = [&](int x, int y, int z) {
    return x + 1 + std::size_t(p) * (y + 1 + std::size_t(p) * (z + 1));
  };
  std::size_t i = 0;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) loops[at(x, y, z)] = std::min(1e10f, std::fabs(g.distance[i++]));
    }
  }
  const double seconds = seconds_of([&] { reference::sweep_distance_loops(loops, n); }).processor;
  if (!sweep_distance(g.view(), settings, g.grid()).ok()) return 0;
  *difference = 0;
  i = 0;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const double e = std::fabs(double{loops[at(x, y, z)]} - std::fabs(g.distance[i++]));
        *difference = std::max(*difference, e);
      }
    }
  }
  return seconds * 1e9 / g.voxels();
}

void distance(benchmark::State& state) {
  // Orders of sweeping differ by up to 0.28 of a voxel near shocks.
  double difference = 1e9;
  const double loops = distance_loops(&difference);
  if (!(difference < 0.3)) return state.SkipWithError("the result is wrong");
  Gyroid g(static_cast<int>(state.range(0)));
  auto executor = make_executor(static_cast<int>(state.range(1)));
  const float spacing[3] = {1, 1, 1};
  DistanceStage first(g.size[0], g.size[1], spacing, false, executor->thread_count());
  DistanceStage second(g.size[0], g.size[1], spacing, true, executor->thread_count());
  DistanceSettings settings;
  settings.solid = SolidSide::kBelow;
  std::vector<Seconds> times;
  for (auto _ : state) {
    start_distance(g.view(), 0, settings, g.grid(), *executor);
    times.push_back(seconds_of([&] { sweep_eight(g, first, second, *executor); }));
    state.SetIterationTime(times.back().wall);
  }
  report(state, times, g.voxels(), loops);
  // Work and the longest chain, in vectors of a strip.
  const DistanceStage::Count count = first.count(g.size[2]);
  state.counters["work"] = double(count.work);
  state.counters["span"] = double(count.span);
  state.counters["work/span"] = double(count.work) / double(count.span);
}
BENCHMARK(distance)
    ->Name("volume_distance")
    ->ArgNames({"side", "threads"})
    ->Args({128, 1})
    ->Args({256, 1})
    ->Args({256, 2})
    ->Args({512, 1})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// OpenVDB's fogToSdf on the same voxels, beside our eight sweeps with their start.
void fog_to_sdf(benchmark::State& state) {
  if (!tools::has_openvdb()) return state.SkipWithError("this build has no OpenVDB");
  const int n = static_cast<int>(state.range(0));
  Gyroid g(n);
  // Closed at the border: OpenVDB takes the border for a surface where matter reaches it.
  for (int i = 0; i < n * n * n; ++i) {
    const int x = i % n, y = i / n % n, z = i / n / n;
    const int depth = std::min({x, y, z, n - 1 - x, n - 1 - y, n - 1 - z});
    g.values[std::size_t(i)] = std::min(g.values[std::size_t(i)], float(depth) - 0.7f);
  }
  const int threads = static_cast<int>(state.range(1));
  auto executor = make_executor(threads);
  RunOptions run;
  run.executor = executor.get();
  if (!sweep_distance(g.view(), {}, g.grid(), run).ok()) return state.SkipWithError("refused");
  const std::vector<float> ours = g.distance;
  std::vector<Seconds> own;
  for (int i = 0; i < 5; ++i) {
    own.push_back(seconds_of([&] { (void)!sweep_distance(g.view(), {}, g.grid(), run).ok(); }));
  }
  report(state, own, g.voxels(), 0);
  double seconds = 0;
  for (auto _ : state) {
    if (!tools::openvdb_distance(g.view(), 0, threads, g.grid(), &seconds).ok()) {
      return state.SkipWithError("OpenVDB refused");
    }
    state.SetIterationTime(seconds);
  }
  double difference = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    difference += std::fabs(double{ours[i]} - g.distance[i]) / g.voxels();
  }
  if (!(difference < 0.3)) return state.SkipWithError("the distances differ");
  const double ns = seconds * 1e9 / g.voxels();
  state.counters["openvdb_ns/voxel"] = ns;
  state.counters["openvdb_times"] = ns / state.counters["ns/voxel"];
}
BENCHMARK(fog_to_sdf)
    ->Name("volume_openvdb_distance")
    ->ArgNames({"side", "threads"})
    ->Args({256, 1})
    ->Args({256, 2})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// ns per voxel of equation 6 in plain loops, and their largest difference from the library.
double octant_loops(double* difference) {
  Gyroid g(kLoopSide);
  DistanceSettings settings;
  settings.solid = SolidSide::kBelow;
  if (!sweep_distance(g.view(), settings, g.grid()).ok()) return 0;
  std::vector<std::uint8_t> tau(g.values.size());
  for (std::size_t i = 0; i < tau.size(); ++i) {
    tau[i] = std::uint8_t(255 * std::clamp(g.distance[i] + 0.5f, 0.0f, 1.0f) + 0.5f);
  }
  const std::size_t p = kLoopSide + 2;
  std::vector<float> w(p * p * p), v(8 * tau.size());
  const double seconds =
      seconds_of([&] { reference::sweep_octants_loops(tau, kLoopSide, w, v); }).processor;
  VisibilityField field;
  if (!sweep_occlusion(g.grid(), {.transport = Transport::kPaper}, &field).ok()) return 0;
  *difference = 0;
  std::vector<float> one(tau.size());
  for (int s = 0; s < 8; ++s) {
    if (!field.octant(s, {one.data(), g.size, {1, 1, 1}}).ok()) return 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      *difference = std::max(*difference, std::fabs(double{one[i]} - v[8 * i + s]));
    }
  }
  return seconds * 1e9 / g.voxels();
}

// Equation 6 from tau in bytes to two volumes of four bytes.
void octants(benchmark::State& state) {
  double difference = 1e9;
  const double loops = octant_loops(&difference);
  if (!(difference < 0.01)) return state.SkipWithError("the result is wrong");
  Gyroid g(static_cast<int>(state.range(0)));
  std::vector<std::uint8_t> tau(g.values.size());
  for (std::size_t i = 0; i < tau.size(); ++i) {
    tau[i] = std::uint8_t(255 * std::clamp(g.values[i] + 0.5f, 0.0f, 1.0f) + 0.5f);
  }
  std::vector<std::uint8_t> out[2];
  for (auto& o : out) o.assign(4 * tau.size(), 0);
  auto executor = make_executor(static_cast<int>(state.range(1)));
  const TransportScheme scheme = transport_scheme(Transport::kPaper, {1, 1, 1});
  std::vector<Seconds> times;
  for (auto _ : state) {
    times.push_back(seconds_of([&] {
      std::vector<OcclusionSweep> halves;
      for (int half = 0; half < 2; ++half) {
        halves.push_back(
            {tau.data(), g.size, half == 0, scheme.directions.data(), 1, out[half].data()});
      }
      const int workers = executor->thread_count();
      OcclusionPipeline pipeline(halves, workers);
      executor->parallel_for(workers,
                             [&](int worker, int) { pipeline.work(worker, [] { return true; }); });
    }));
    state.SetIterationTime(times.back().wall);
  }
  report(state, times, g.voxels(), loops);
}
BENCHMARK(octants)
    ->Name("volume_octants")
    ->ArgNames({"side", "threads"})
    ->Args({256, 1})
    ->Args({256, 2})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// A transport as users call it, from distances to a field whose memory is used again.
void transport(benchmark::State& state) {
  Gyroid g(static_cast<int>(state.range(0)));
  g.distance = g.values;
  auto executor = make_executor(static_cast<int>(state.range(2)));
  RunOptions run;
  run.executor = executor.get();
  OcclusionSettings settings;
  settings.transport = static_cast<Transport>(state.range(1));
  state.SetLabel(enum_name(settings.transport));
  VisibilityField field;
  if (!sweep_occlusion(g.grid(), settings, &field, run).ok()) {
    return state.SkipWithError("the input was refused");
  }
  std::vector<Seconds> times;
  for (auto _ : state) {
    times.push_back(
        seconds_of([&] { (void)!sweep_occlusion(g.grid(), settings, &field, run).ok(); }));
    state.SetIterationTime(times.back().wall);
  }
  report(state, times, g.voxels(), 0);
  state.counters["bytes/voxel"] = double(field.bytes()) / g.voxels();
  // The sweep's work and longest chain, in strips of rows.
  const TransportScheme scheme = transport_scheme(settings.transport, {1, 1, 1});
  std::vector<OcclusionSweep> halves(2);
  for (OcclusionSweep& half : halves) {
    half.size = field.size();
    half.directions = scheme.directions.data();
    half.count = static_cast<int>(scheme.directions.size());
  }
  const OcclusionPipeline::Count count = OcclusionPipeline(halves, 1).count();
  state.counters["work"] = double(count.work);
  state.counters["span"] = double(count.span);
  state.counters["work/span"] = double(count.work) / double(count.span);
}
BENCHMARK(transport)
    ->Name("volume_transport")
    ->ArgNames({"side", "transport", "threads"})
    ->ArgsProduct({{256}, {0, 1, 2, 3}, {1, 2}})
    ->Args({128, 2, 1})
    ->Args({512, 2, 1})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obscura::bench
