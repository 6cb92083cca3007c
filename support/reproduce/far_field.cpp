#include "support/reproduce/far_field.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "fmt/format.h"
#include "obscura/estimator.h"
#include "support/metrics/compare.h"
#include "support/pictures/pictures.h"
#include "support/pictures/plot.h"
#include "support/reference/geometric.h"
#include "support/scenes/load_scene.h"

namespace obscura::support {
namespace {

constexpr int kRuns = 3, kTruthEvery = 5, kTruthRays = 1024;

// The paper's two scenes: plane walls with a long falloff, foliage with a shorter one, both with a
// guard band of 10 %. Lengths are shares of the scene's size.
struct PaperScene {
  const char* name;
  double radius;
};
constexpr PaperScene kScenes[] = {{"hall", 0.1}, {"meadow", 0.04}};

struct View {
  Rendering rendering;
  Falloff falloff;
  int width = 0, height = 0;
};
Status load(const PaperScene& scene, ImageSize size, Executor& executor, View* view) {
  ViewOptions options;
  options.size = size;
  Status s = load_scene(std::string("scene:") + scene.name, options, executor, &view->rendering);
  view->falloff.radius = static_cast<float>(scene.radius * view->rendering.gbuffer.scene_size);
  view->width = size.width;
  view->height = size.height;
  return s;
}

// Median time of some runs, the first of all left out, and the result.
Status measure(const View& view, const MethodSettings& settings, Executor& executor,
               std::vector<float>* result, double* milliseconds) {
  const DepthField field = view.rendering.gbuffer.field();
  result->resize(static_cast<std::size_t>(view.width) * view.height);
  Outputs outputs;
  outputs.visibility = {result->data(), view.width, view.height};
  RunOptions options;
  options.executor = &executor;
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, 0, &estimator);
      !s.ok()) {
    return s;
  }
  std::vector<double> times;
  for (int run = 0; run <= kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    if (Status s = estimator.run(field, outputs, options); !s.ok()) return s;
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    if (run > 0) times.push_back(time.count());
  }
  std::nth_element(times.begin(), times.begin() + kRuns / 2, times.end());
  *milliseconds = times[kRuns / 2];
  return {};
}

Status trace_truth(const View& view, int rays, Executor& executor, std::vector<float>* truth) {
  ReferenceSettings settings;
  settings.falloff = view.falloff;
  settings.rays = rays;
  settings.every = kTruthEvery;
  truth->resize(static_cast<std::size_t>(view.width) * view.height);
  Outputs outputs;
  outputs.visibility = {truth->data(), view.width, view.height};
  RunOptions options;
  options.executor = &executor;
  return compute(view.rendering.gbuffer.field(), settings, outputs, options);
}

FarFieldSettings far_field(const View& view, int directions, int segments) {
  FarFieldSettings s;
  s.falloff = view.falloff;
  s.directions = directions;
  s.segments = segments;
  return s;
}
MipmapSettings mipmap(const View& view, int directions) {
  MipmapSettings s;
  s.falloff = view.falloff;
  s.directions = directions;
  return s;
}

Status cancelled() { return {StatusCode::kCancelled, "stopped by the user"}; }

constexpr ImageSize kSizes[] = {{1280, 720}, {1920, 1080}};

std::string name_of(ImageSize size) { return fmt::format("{}x{}", size.width, size.height); }

}  // namespace

Status reproduce_ffao_table1(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  std::vector<float> result;
  double ms = 0;
  for (const ImageSize size : kSizes) {
    if (!context.step(name_of(size), size.height > 720 ? 0.3 : 0.0)) return cancelled();
    View view;
    if (Status s = load(kScenes[1], size, *executor, &view); !s.ok()) return s;
    for (const int directions : {8, 16}) {
      FarFieldSettings settings = far_field(view, directions, 2);
      settings.near_field = false;
      if (Status s = measure(view, settings, *executor, &result, &ms); !s.ok()) return s;
      report->add(fmt::format("far field alone, K = {}x2", directions), name_of(size), ms, "ms");
      settings.near_field = true;
      settings.near_step = NearStep::of(1);
      if (Status s = measure(view, settings, *executor, &result, &ms); !s.ok()) return s;
      report->add(fmt::format("with near field, K = {}x2", directions), name_of(size), ms, "ms");
    }
    if (Status s = measure(view, mipmap(view, 16), *executor, &result, &ms); !s.ok()) return s;
    report->add("mipmap, K = 16, near field included", name_of(size), ms, "ms");
  }
  *text = "Scene meadow. The paper's times are for its far field on a Radeon 7970.\n";
  return {};
}

Status reproduce_ffao_table3(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  View view;
  if (Status s = load(kScenes[1], kSizes[0], *executor, &view); !s.ok()) return s;
  std::vector<float> result;
  for (const int interval : {20, 10, 5}) {
    if (!context.step(fmt::format("B0 = {}", interval), (20 - interval) / 20.0)) return cancelled();
    FarFieldSettings settings = far_field(view, 8, 2);
    settings.interval = interval;
    settings.near_field = false;
    double ms = 0;
    if (Status s = measure(view, settings, *executor, &result, &ms); !s.ok()) return s;
    report->add(fmt::format("B0 = {}", interval), "time", ms, "ms");
  }
  *text = "Scene meadow, 1280x720, K = 8x2, far field alone.\n";
  return {};
}

Status reproduce_ffao_fig7(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  double done = 0;
  for (const PaperScene& scene : kScenes) {
    View view;
    if (Status s = load(scene, {640, 360}, *executor, &view); !s.ok()) return s;
    if (!context.step(fmt::format("{}: truth", scene.name), done)) return cancelled();
    std::vector<float> truth, result;
    if (Status s = trace_truth(view, kTruthRays, *executor, &truth); !s.ok()) return s;
    const ImageView<const float> truth_view(truth.data(), view.width, view.height);
    FarFieldSettings slab8 = far_field(view, 8, 2);
    slab8.profile = SlabProfile::kSlab;
    slab8.near_step = NearStep::of(1);
    FarFieldSettings slab16 = slab8;
    slab16.directions = 16;
    const std::pair<const char*, MethodSettings> methods[] = {
        {"as in the paper 8x2", slab8},
        {"as in the paper 16x2", slab16},
        {"adaptive chord 8x2", far_field(view, 8, 2)},
        {"adaptive chord 16x2", far_field(view, 16, 2)},
        {"mipmap 16", mipmap(view, 16)}};
    std::vector<Image> rows;
    for (const auto& [name, settings] : methods) {
      done += 0.5 / std::size(methods);
      if (!context.step(fmt::format("{}: {}", scene.name, name), done)) return cancelled();
      double ms = 0;
      if (Status s = measure(view, settings, *executor, &result, &ms); !s.ok()) return s;
      const ImageView<const float> image(result.data(), view.width, view.height);
      Comparison c;
      if (Status s = compare(image, truth_view, {}, &c); !s.ok()) return s;
      const std::string row = fmt::format("{}, {}", scene.name, name);
      report->add(row, "e_A", c.e_a, "%");
      report->add(row, "e_<5%", c.within_5, "%");
      report->add(row, "bias", c.bias, "%");
      report->add(row, "time", ms, "ms");
      rows.push_back(beside({{name, grey_picture(image)}}));
    }
    if (Status s = context.picture(scene.name, stack(rows)); !s.ok()) return s;
  }
  *text = fmt::format(
      "Truth: {} rays at every {}th pixel, solid depth field. 640x360 with a guard band of 10 %, "
      "exponential falloff of 10 % (hall) and 4 % (meadow) of the scene's size.\n",
      kTruthRays, kTruthEvery);
  return {};
}

Status reproduce_error_vs_time(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  double done = 0;
  for (const PaperScene& scene : kScenes) {
    View view;
    if (Status s = load(scene, {640, 360}, *executor, &view); !s.ok()) return s;
    if (!context.step(fmt::format("{}: truths", scene.name), done)) return cancelled();
    std::vector<float> truth, result;
    if (Status s = trace_truth(view, kTruthRays, *executor, &truth); !s.ok()) return s;
    std::vector<float> world(truth.size());
    GeometricSettings geometric;
    geometric.falloff = view.falloff;
    geometric.every = kTruthEvery;
    Outputs outputs;
    outputs.visibility = {world.data(), view.width, view.height};
    RunOptions options;
    options.executor = executor.get();
    if (Status s = trace_geometric(view.rendering, geometric, outputs, options); !s.ok()) return s;

    std::vector<std::pair<std::string, MethodSettings>> methods;
    for (const auto preset :
         {FarFieldPreset::kFast, FarFieldPreset::kBalanced, FarFieldPreset::kHigh}) {
      FarFieldSettings s = far_field(view, 8, 2);
      s.preset = preset;
      methods.emplace_back("far field", s);
    }
    for (const int k : {8, 16, 32}) methods.emplace_back("mipmap", mipmap(view, k));
    for (const int rays : {4, 16, 64}) {
      ReferenceSettings s;
      s.falloff = view.falloff;
      s.rays = rays;
      s.seed = 2;
      methods.emplace_back("ray-traced", s);
    }
    const std::pair<const char*, const std::vector<float>*> truths[] = {
        {"solid depth field", &truth}, {"real geometry", &world}};
    Plot plots[2];
    for (int i = 0; i < 2; ++i) {
      plots[i].title = fmt::format("{}, truth: {}", scene.name, truths[i].first);
      plots[i].x_label = "ms";
      plots[i].y_label = "e_A, %";
    }
    int number = 0;
    for (const auto& [name, settings] : methods) {
      done += 0.5 / static_cast<double>(methods.size());
      if (!context.step(fmt::format("{}: {}", scene.name, name), done)) return cancelled();
      double ms = 0;
      if (Status s = measure(view, settings, *executor, &result, &ms); !s.ok()) return s;
      const std::string row = fmt::format("{}, {} {}", scene.name, name, ++number);
      report->add(row, "time", ms, "ms");
      for (int i = 0; i < 2; ++i) {
        Comparison c;
        if (Status s = compare({result.data(), view.width, view.height},
                               {truths[i].second->data(), view.width, view.height}, {}, &c);
            !s.ok()) {
          return s;
        }
        report->add(row, fmt::format("e_A, {}", truths[i].first), c.e_a, "%");
        auto& series = plots[i].series;
        if (series.empty() || series.back().name != name) {
          series.emplace_back();
          series.back().name = name;
        }
        series.back().points.emplace_back(ms, c.e_a);
      }
    }
    for (int i = 0; i < 2; ++i) {
      const std::string what = fmt::format("{}-{}", scene.name, i == 0 ? "solid" : "geometric");
      if (Status s = context.plot(what, plots[i].to_svg()); !s.ok()) return s;
    }
  }
  *text =
      "Far field: presets fast, balanced, high; mipmap: K = 8, 16, 32; ray-traced: 4, 16, 64.\n";
  return {};
}

}  // namespace obscura::support
