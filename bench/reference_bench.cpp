#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/progress.h"
#include "obscura/reference.h"
#include "scene/scenes/load_scene.h"
#include "screen/method.h"

namespace obscura::bench {
namespace {

struct Setup {
  tools::DepthInput input;
  view::Geometry geometry;
  std::unique_ptr<Method> method;
  std::unique_ptr<Executor> executor;
  std::vector<float> visibility, error;
  Outputs outputs;
  int pixels = 0;
};

std::unique_ptr<Setup> make_setup(const ReferenceSettings& settings, const char* scene,
                                  int threads) {
  auto s = std::make_unique<Setup>();
  if (!tools::load_scene(scene, &s->input).ok()) return nullptr;
  s->executor = make_executor(threads);
  if (!make_method(settings, s->input.width, s->input.height, &s->method).ok()) return nullptr;
  const DepthField field = s->input.field();
  if (!view::convert(field, s->method->needs(), *s->executor, &s->geometry).ok()) return nullptr;
  const int w = s->geometry.visible().width, h = s->geometry.visible().height;
  s->visibility.resize(static_cast<std::size_t>(w) * h);
  s->error.resize(s->visibility.size());
  s->outputs.visibility = {s->visibility.data(), w, h};
  s->outputs.standard_error = {s->error.data(), w, h};
  for (int y = settings.every / 2; y < h; y += settings.every) {
    for (int x = settings.every / 2; x < w; x += settings.every) {
      s->pixels += std::isfinite(
          s->geometry.depth(x + s->geometry.guard_band.left, y + s->geometry.guard_band.top));
    }
  }
  return s;
}

// Checks that two seeds differ by as much as their standard errors, and that every pixel is in [0,
// 1].
bool plausible(Setup* s, ReferenceSettings settings) {
  const std::function<bool(double)> no_progress;
  const RunContext context{*s->executor, no_progress};
  if (!s->method->run(s->geometry, s->outputs, context).ok()) return false;
  const std::vector<float> first = s->visibility;
  settings.seed += 1;
  std::unique_ptr<Method> other;
  if (!make_method(settings, s->input.width, s->input.height, &other).ok()) return false;
  if (!other->run(s->geometry, s->outputs, context).ok()) return false;
  double differences = 0, variances = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (std::isnan(first[i])) continue;
    if (!(first[i] >= 0 && first[i] <= 1)) return false;
    differences += std::pow(first[i] - s->visibility[i], 2);
    variances += 2 * std::pow(s->error[i], 2);
  }
  return variances > 0 && differences / variances > 0.5 && differences / variances < 1.5;
}

void run(benchmark::State& state, const ReferenceSettings& settings, const char* scene,
         int threads) {
  const std::unique_ptr<Setup> s = make_setup(settings, scene, threads);
  if (!s) return state.SkipWithError("the input was refused");
  if (!plausible(s.get(), settings)) return state.SkipWithError("the result is wrong");
  const std::function<bool(double)> no_progress;
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    if (!s->method->run(s->geometry, s->outputs, {*s->executor, no_progress}).ok()) return;
    times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  const double rays = static_cast<double>(s->pixels) * settings.rays;
  const double rate = rays / times[times.size() / 2] / 1e6;
  state.counters["Mrays/s"] = rate;
  state.counters["Mrays/s/thread"] = rate / threads;
}

// Goal: 3 million rays per second and thread on the hall at 1280x720, with a radius as long as the
// hall.
void reference(benchmark::State& state, Occluder occluder) {
  ReferenceSettings settings{.occluder = Occluder::solid()};
  settings.falloff.radius = 20;
  settings.occluder = occluder;
  settings.rays = static_cast<int>(state.range(0));
  settings.every = static_cast<int>(state.range(1));
  run(state, settings, "scene:hall?size=1280x720&layers=4", static_cast<int>(state.range(2)));
}

void solid(benchmark::State& state) { reference(state, Occluder::solid()); }
void thickness(benchmark::State& state) { reference(state, Occluder::of_thickness(0.5f)); }
void layers(benchmark::State& state) { reference(state, Occluder::of_layers(4)); }

BENCHMARK(solid)
    ->Name("reference/solid")
    ->ArgNames({"rays", "every", "threads"})
    ->Args({1024, 20, 1})
    ->Args({1024, 20, 2})
    ->Args({64, 5, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(thickness)
    ->Name("reference/thickness")
    ->ArgNames({"rays", "every", "threads"})
    ->Args({1024, 20, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(layers)
    ->Name("reference/layers")
    ->ArgNames({"rays", "every", "threads"})
    ->Args({1024, 20, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace obscura::bench
