// Volumetric obscurance: point, line and area kernels on the hall, beside the tap bound.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bench/bench_input.h"
#include "bench/tap_bound.h"
#include "screen/volumetric/area/moments.h"
#include "screen/volumetric/area/plan.h"
#include "screen/volumetric/line/plan.h"
#include "screen/volumetric/point/plan.h"
#include "tests/reference/volumetric.h"

namespace obscura::bench {
namespace {

// A radius of 2.5 % of the scene: 10 to 60 pixels over most of the image.
constexpr double kRadiusOfScene = 0.025;

struct Setup {
  tools::DepthInput input;
  view::Geometry geometry;
  std::unique_ptr<Executor> executor;
  std::vector<float> result;
  Outputs outputs;
  float radius = 0;

  Status run(Method* method) {
    static const std::function<bool(double)> kNoProgress;
    return method->run(geometry, outputs, {*executor, kNoProgress});
  }
};

std::unique_ptr<Setup> make_setup(bool normals, int threads, int width, int height) {
  auto s = std::make_unique<Setup>();
  s->input = bench_input(width, height);
  s->executor = make_executor(threads);
  DepthField field = s->input.field();
  field.normal_use = normals ? NormalUse::kAuto : NormalUse::kNone;
  if (!view::convert(field, {.normals = true, .works_without_normals = true}, *s->executor,
                     &s->geometry)
           .ok())
    return nullptr;
  s->result.resize(static_cast<std::size_t>(width) * height);
  s->outputs.visibility = {s->result.data(), width, height};
  s->radius = static_cast<float>(kRadiusOfScene * s->input.scene_size);
  return s;
}

// Reports the method's median and fastest time over the benchmark's iterations: of this thread, or,
// where there are more, on the wall.
void time(benchmark::State& state, Setup* s, Method* method) {
  const bool alone = s->executor->thread_count() == 1;
  auto now = [alone] {
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return alone ? thread_seconds() : std::chrono::duration<double>(wall).count();
  };
  std::vector<double> times;
  for (auto _ : state) {
    const double start = now();
    (void)s->run(method);
    times.push_back(now() - start);
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  state.counters["median_ms"] = times[times.size() / 2] * 1e3;
  state.counters["best_ms"] = *std::min_element(times.begin(), times.end()) * 1e3;
}

// Share of tested pixels that differ from the evaluation in double precision. A tap on the border
// between two texels may read either.
template <class Reference>
bool agrees(const Setup& s, const Reference& reference) {
  int pixels = 0, wrong = 0;
  for (int y = 3; y < s.geometry.height; y += 31) {
    for (int x = 1; x < s.geometry.width; x += 13) {
      const double expected = reference.visibility(x, y);
      wrong += !(std::abs(s.outputs.visibility(x, y) - expected) < 5e-5);
      ++pixels;
    }
  }
  return wrong < 0.005 * pixels;
}

// The texels that a pattern (y down) fetches as it is, not reflected.
template <class Sample>
void find_taps(const view::Geometry& g, float radius, std::span<const Sample> pattern, int y,
               std::vector<std::int32_t>* index) {
  const int lanes = tap_lanes(), middle = g.height / 2;
  for (int x0 = 0; x0 < g.width; x0 += lanes) {
    for (const Sample& p : pattern) {
      for (int x = x0; x < x0 + lanes; ++x) {
        const float z = g.depth(std::min(x, g.width - 1), y);
        const long dx = std::lrint(radius / g.camera.scale_x / z * p.x);
        const long dy = std::lrint(radius / g.camera.scale_y / z * p.y);
        const int i = std::clamp(x + static_cast<int>(dx), 0, g.width - 1);
        const int j = std::clamp(y + static_cast<int>(dy), 0, g.height - 1);
        index->push_back((j - middle) * static_cast<int>(g.depth.stride()) + i);
      }
    }
  }
}

// The fraction of its tap bound that the kernel reaches with a fixed pattern (y down). Both are
// measured alternately under the same conditions: a few rows with warm caches, the fastest of
// several runs.
template <class Sample>
void report_bound(benchmark::State& state, Setup* s, Method* method,
                  std::span<const Sample> pattern) {
  if (s->executor->thread_count() != 1) return;
  constexpr int kRowsAtOnce = 8, kRuns = 9;
  view::Geometry& g = s->geometry;
  const ImageView<float> whole = s->outputs.visibility;
  double kernel = 0, bound = 0;
  for (int y = 0; y < g.height; y += kRowsAtOnce) {
    const int rows = std::min(kRowsAtOnce, g.height - y);
    g.guard_band = {0, 0, y, g.height - y - rows};
    s->outputs.visibility = {s->result.data(), g.width, rows};
    kernel += fastest_seconds(kRuns, [&] { (void)s->run(method); });
    bound += tap_bound_seconds(g.depth.row(g.height / 2), y, y + rows, kRuns,
                               [&](int row, std::vector<std::int32_t>* index) {
                                 find_taps(g, s->radius, pattern, row, index);
                               });
  }
  g.guard_band = {};
  s->outputs.visibility = whole;
  state.counters["bound_ms"] = bound * 1e3;
  state.counters["kernel_ms"] = kernel * 1e3;
  state.counters["of_bound"] = bound / kernel;
}

template <class Settings>
Settings settings_of(const benchmark::State& state, const Setup& s) {
  Settings settings;
  settings.falloff.radius = s.radius;
  settings.samples = static_cast<int>(state.range(0));
  settings.rotate = state.range(2) != 0;
  settings.blur = false;
  return settings;
}

constexpr const char* kRefused = "the input or the settings were refused";
constexpr const char* kWrong = "the result is wrong";

template <class Sample>
std::vector<Sample> y_down(std::span<const Sample> pattern) {
  std::vector<Sample> result(pattern.begin(), pattern.end());
  for (Sample& s : result) s.y = -s.y;
  return result;
}

void line(benchmark::State& state, int width, int height) {
  auto s = make_setup(state.range(1) != 0, static_cast<int>(state.range(3)), width, height);
  std::unique_ptr<Method> method;
  const auto settings = settings_of<LineSettings>(state, *s);
  if (!make_method(settings, width, height, &method).ok() || !s->run(method.get()).ok()) {
    return state.SkipWithError(kRefused);
  }
  const std::span<const DiskSample> pattern = disk_pattern(settings.samples, false);
  if (!agrees(*s, reference::Line(s->geometry, settings, pattern))) {
    return state.SkipWithError(kWrong);
  }
  time(state, s.get(), method.get());
  if (!settings.rotate) report_bound(state, s.get(), method.get(), pattern);
}

void point(benchmark::State& state, int width, int height) {
  auto s = make_setup(state.range(1) != 0, static_cast<int>(state.range(3)), width, height);
  std::unique_ptr<Method> method;
  const auto settings = settings_of<PointSettings>(state, *s);
  if (!make_method(settings, width, height, &method).ok() || !s->run(method.get()).ok()) {
    return state.SkipWithError(kRefused);
  }
  const std::span<const BallSample> pattern = ball_pattern(settings.samples);
  if (!agrees(*s, reference::Point(s->geometry, settings, pattern))) {
    return state.SkipWithError(kWrong);
  }
  time(state, s.get(), method.get());
  if (!settings.rotate) {
    report_bound(state, s.get(), method.get(), std::span<const BallSample>(y_down(pattern)));
  }
}

// A plane that faces the camera, as the same camera sees it.
view::Geometry flat(const view::Geometry& like) {
  view::Geometry g;
  g.width = like.width;
  g.height = like.height;
  g.camera = like.camera;
  g.has_normals = like.has_normals;
  for (auto* image : {&g.depth, &g.normal_x, &g.normal_y, &g.normal_z}) {
    image->resize(g.width, g.height);
    const float value = image == &g.depth ? like.max_depth : image == &g.normal_z ? 1.0f : 0.0f;
    std::fill_n(image->data(), image->stride() * g.height, value);
  }
  return g;
}

// With the pyramid; its own time is that of area/samples:0.
void area(benchmark::State& state, int width, int height) {
  auto s = make_setup(state.range(1) != 0, static_cast<int>(state.range(3)), width, height);
  const auto settings = settings_of<AreaSettings>(state, *s);
  if (settings.samples == 0) {
    MomentPyramid pyramid;
    pyramid.resize(width, height);
    for (auto _ : state) pyramid.build(s->geometry, 1.25f, *s->executor);
    return;
  }
  std::unique_ptr<Method> method;
  if (!make_method(settings, width, height, &method).ok() || !s->run(method.get()).ok()) {
    return state.SkipWithError(kRefused);
  }
  // Where all is at one depth, half of the sphere is open, or with normals all of it.
  view::Geometry scene = std::move(s->geometry);
  s->geometry = flat(scene);
  if (!s->run(method.get()).ok()) return state.SkipWithError(kRefused);
  const float expected = s->geometry.has_normals ? 1.0f : 0.5f;
  for (const float v : s->result) {
    if (!(std::abs(v - expected) < 2e-3f)) return state.SkipWithError(kWrong);
  }
  s->geometry = std::move(scene);
  time(state, s.get(), method.get());
}

void hd(benchmark::internal::Benchmark* b) {
  b->ArgNames({"samples", "normals", "rotate", "threads"})
      ->Unit(benchmark::kMillisecond)
      ->MinTime(0.3)
      ->UseRealTime();
}

BENCHMARK_CAPTURE(line, 1280x720, 1280, 720)
    ->Apply(hd)
    ->Args({9, 0, 0, 1})
    ->Args({9, 0, 0, 2})
    ->Args({9, 1, 0, 1})
    ->Args({5, 0, 0, 1})
    ->Args({1, 0, 0, 1})
    ->Args({1, 1, 1, 1})
    ->Args({5, 1, 1, 1})
    ->Args({9, 1, 1, 1})
    ->Args({9, 0, 1, 1})
    ->Args({5, 0, 1, 1});
BENCHMARK_CAPTURE(point, 1280x720, 1280, 720)
    ->Apply(hd)
    ->Args({12, 0, 0, 1})
    ->Args({33, 0, 0, 1})
    ->Args({12, 1, 0, 1})
    ->Args({12, 0, 1, 1})
    ->Args({33, 0, 1, 1})
    ->Args({12, 1, 1, 1})
    ->Args({33, 1, 1, 1});
BENCHMARK_CAPTURE(area, 1280x720, 1280, 720)
    ->Apply(hd)
    ->Args({0, 0, 0, 1})
    ->Args({1, 0, 0, 1})
    ->Args({9, 0, 0, 1})
    ->Args({1, 1, 1, 1})
    ->Args({9, 1, 1, 1});
BENCHMARK_CAPTURE(line, 1024x1024, 1024, 1024)
    ->Apply(hd)
    ->Args({5, 0, 0, 1})
    ->Args({9, 0, 0, 1})
    ->Args({5, 1, 1, 1})
    ->Args({9, 1, 1, 1});
BENCHMARK_CAPTURE(point, 1024x1024, 1024, 1024)
    ->Apply(hd)
    ->Args({12, 0, 0, 1})
    ->Args({33, 0, 0, 1})
    ->Args({12, 1, 1, 1})
    ->Args({33, 1, 1, 1});

}  // namespace
}  // namespace obscura::bench
