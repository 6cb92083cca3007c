#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bench/bench_input.h"
#include "bench/tap_bound.h"
#include "screen/line/line.h"
#include "tests/reference/volumetric.h"

namespace obscura::bench {
namespace {

constexpr float kRadius = 0.5f;

struct Setup {
  support::DepthInput input;
  view::Geometry geometry;
  LineSettings settings;
  std::unique_ptr<Method> method;
  std::unique_ptr<Executor> executor;
  std::vector<float> result;
  Outputs outputs;
};

// Converted input and a method, without the blur.
std::unique_ptr<Setup> make_setup(const LineSettings& settings, bool normals, int threads,
                                  int width, int height) {
  auto s = std::make_unique<Setup>();
  s->input = bench_input(width, height);
  s->executor = make_executor(threads);
  s->settings = settings;
  DepthField field = s->input.field();
  field.normal_use = normals ? NormalUse::kAuto : NormalUse::kNone;
  if (!view::convert(field, {.normals = true}, *s->executor, &s->geometry).ok()) return nullptr;
  if (!make_line(settings, &s->method).ok()) return nullptr;
  s->result.resize(static_cast<std::size_t>(width) * height);
  s->outputs.visibility = {s->result.data(), width, height};
  return s;
}

// Share of a sample of pixels that differ from the double-precision evaluation; taps on the border
// of two texels may fall to either side.
double share_wrong(const Setup& s) {
  const reference::Line reference(s.geometry, s.settings, disk_pattern(s.settings.samples, false));
  int pixels = 0, wrong = 0;
  for (int y = 3; y < s.geometry.height; y += 31) {
    for (int x = 1; x < s.geometry.width; x += 13) {
      const double expected = reference.visibility(x, y);
      wrong += !(std::abs(s.outputs.visibility(x, y) - expected) < 2e-5);
      ++pixels;
    }
  }
  return static_cast<double>(wrong) / pixels;
}

// The texels that the pattern fetches as it is, not reflected.
double line_bound(const Setup& s) {
  const view::Geometry& g = s.geometry;
  const std::span<const DiskSample> pattern = disk_pattern(s.settings.samples, false);
  const int lanes = tap_lanes(), middle = g.height / 2;
  return tap_bound_seconds(
      g.depth.row(middle), g.height, 11, [&](int y, std::vector<std::int32_t>* index) {
        for (int x0 = 0; x0 < g.width; x0 += lanes) {
          for (const DiskSample& p : pattern) {
            for (int x = x0; x < x0 + lanes; ++x) {
              const float z = g.depth(std::min(x, g.width - 1), y);
              const float dx = s.settings.falloff.radius / g.camera.scale_x / z * p.x;
              const float dy = s.settings.falloff.radius / g.camera.scale_y / z * p.y;
              const int i = std::clamp(x + int(std::lrint(dx)), 0, g.width - 1);
              const int j = std::clamp(y + int(std::lrint(dy)), 0, g.height - 1);
              index->push_back((j - middle) * int(g.depth.stride()) + i);
            }
          }
        }
      });
}

void run(benchmark::State& state, const LineSettings& settings, bool normals, int threads,
         int width, int height) {
  const std::unique_ptr<Setup> s = make_setup(settings, normals, threads, width, height);
  if (!s) return state.SkipWithError("the input was refused");
  const std::function<bool(double)> no_progress;
  auto once = [&] {
    return s->method->run(s->geometry, s->outputs, {*s->executor, no_progress}).ok();
  };
  if (!once() || share_wrong(*s) > 0.002) return state.SkipWithError("the result is wrong");
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    once();
    times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  const double median = times[times.size() / 2];
  state.counters["median_ms"] = median * 1e3;
  if (!settings.rotate) {
    const double pixels = static_cast<double>(width) * height;
    const double bound = line_bound(*s);
    state.counters["bound_ms"] = bound * 1e3;
    state.counters["ns/px/tap"] = bound * 1e9 / pixels / settings.samples;
    state.counters["of_bound"] = bound / median;  // the fraction of the tap bound that is reached
  }
}

LineSettings fixed(int samples) {
  LineSettings s;
  s.falloff.radius = kRadius;
  s.samples = samples;
  s.rotate = false;
  s.blur = false;
  return s;
}

void line(benchmark::State& state) {
  run(state, fixed(static_cast<int>(state.range(0))), state.range(1) != 0,
      static_cast<int>(state.range(2)), 1280, 720);
}
BENCHMARK(line)
    ->Name("line")
    ->ArgNames({"samples", "normals", "threads"})
    ->Args({9, 0, 1})
    ->Args({9, 0, 2})
    ->Args({9, 1, 1})
    ->Args({5, 0, 1})
    ->Args({5, 1, 1})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.5)
    ->UseRealTime();

}  // namespace
}  // namespace obscura::bench
