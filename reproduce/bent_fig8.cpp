// Figure 8 of bent normals and cones: light through cones against directional occlusion (SSDO),
// which looks the environment up for every sample, at equal time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "fmt/format.h"
#include "obscura/importance.h"
#include "reproduce/bent.h"
#include "reproduce/bent_scenes.h"
#include "scene/light/comparators.h"

namespace obscura::tools {
namespace {

constexpr int kSize = 1024, kEvery = 16, kTruthRays = 4096, kRuns = 3;

// What gives cones their directions, and what SSDO may choose from at equal time.
struct ConeEntry {
  const char* name;
  MethodSettings settings;
};
std::vector<ConeEntry> cone_entries(const Falloff& falloff) {
  return {{"hemisphere",
           HemisphereSettings{
               .falloff = falloff, .occluder = Occluder::solid(), .samples = 16, .steps = 3}},
          {"far field, fast",
           FarFieldSettings{
               .falloff = falloff, .occluder = Occluder::solid(), .preset = FarFieldPreset::kFast}},
          {"far field", FarFieldSettings{.falloff = falloff, .occluder = Occluder::solid()}}};
}
constexpr int kImportanceSamples = 32;
struct SsdoEntry {
  int samples, steps;
};
constexpr SsdoEntry kSsdo[] = {{8, 3}, {16, 3}, {16, 8}, {32, 3}, {32, 8}, {64, 3}, {64, 8}};

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Result {
  double milliseconds = 0, error = 0;
};

Status run_cone(const Rendering& rendering, const MethodSettings& settings, const NamedLight& light,
                const Image& truth, Executor& executor, Result* result, Image* rgb) {
  const DepthField field = rendering.gbuffer.field();
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, &estimator);
      !s.ok()) {
    return s;
  }
  BentBuffers b(rendering.view.width, rendering.view.height);
  RunOptions options;
  options.executor = &executor;
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = Clock::now();
    if (Status s = estimator.run(field, b.cosine_directions(), options); !s.ok()) return s;
    if (Status s = cones_from_cosine_integral(b.visibility, b.bent, b.bent, b.angle, options);
        !s.ok()) {
      return s;
    }
    if (Status s = lit_by(b, rendering, light, {}, executor, rgb); !s.ok()) return s;
    times.push_back(milliseconds_since(start));
  }
  *result = {*std::min_element(times.begin(), times.end()), rmse(*rgb, truth, rendering)};
  return {};
}

Status run_ssdo(const Rendering& rendering, const NamedLight& light, const Image& truth,
                const SsdoEntry& entry, Executor& executor, Result* result, Image* rgb) {
  const DepthField field = rendering.gbuffer.field();
  HemisphereSettings settings{.falloff = bent_falloff(rendering),
                              .occluder = Occluder::solid(),
                              .samples = entry.samples,
                              .steps = entry.steps};
  settings.radiance = light_of_samples(light.convolved, entry.samples, world_from_eye(rendering));
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, &estimator);
      !s.ok()) {
    return s;
  }
  *rgb = Image(rendering.view.width, rendering.view.height);
  for (const char* name : {"R", "G", "B"}) rgb->add(name);
  Outputs o;
  o.radiance = {rgb->view(0), rgb->view(1), rgb->view(2)};
  RunOptions options;
  options.executor = &executor;
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = Clock::now();
    if (Status s = estimator.run(field, o, options); !s.ok()) return s;
    times.push_back(milliseconds_since(start));
  }
  *result = {*std::min_element(times.begin(), times.end()), rmse(*rgb, truth, rendering)};
  return {};
}

Status run_importance(const Rendering& rendering, const NamedLight& light, const Image& truth,
                      Executor& executor, Result* result, Image* rgb) {
  const ImportanceSettings settings{.falloff = bent_falloff(rendering),
                                    .samples = kImportanceSamples,
                                    .world_from_eye = world_from_eye(rendering)};
  *rgb = Image(rendering.view.width, rendering.view.height);
  for (const char* name : {"R", "G", "B"}) rgb->add(name);
  RunOptions options;
  options.executor = &executor;
  const auto start = Clock::now();
  if (Status s = light_by_importance(rendering.gbuffer.field(), light.environment, settings,
                                     {rgb->view(0), rgb->view(1), rgb->view(2)}, options);
      !s.ok()) {
    return s;
  }
  *result = {milliseconds_since(start), rmse(*rgb, truth, rendering)};
  return {};
}

}  // namespace

Status reproduce_bent_fig8(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  std::vector<NamedLight> lights;
  if (Status s = bent_lights(context.data, *executor, &lights); !s.ok()) return s;
  std::vector<double> log_ratio(cone_entries({}).size());
  double done = 0;
  int count = 0;
  for (const std::string& scene : bent_scenes()) {
    Rendering rendering;
    if (Status s = load_bent_scene(scene, kSize, *executor, &rendering); !s.ok()) return s;
    for (const NamedLight& light : lights) {
      if (!context.step(scene, done++ / static_cast<double>(4 * lights.size()))) {
        return {StatusCode::kCancelled, "stopped by the user"};
      }
      Image truth, rgb;
      if (Status s = lit_truth(rendering, light.environment, kTruthRays, kEvery, *executor, &truth);
          !s.ok()) {
        return s;
      }
      const std::string name = scene + ", " + light.name;
      std::vector<Result> ssdo(std::size(kSsdo));
      for (std::size_t i = 0; i < ssdo.size(); ++i) {
        if (Status s = run_ssdo(rendering, light, truth, kSsdo[i], *executor, &ssdo[i], &rgb);
            !s.ok()) {
          return s;
        }
        const std::string label = fmt::format("SSDO {}x{}", kSsdo[i].samples, kSsdo[i].steps);
        report->add(name, label, ssdo[i].error);
        report->add(name, label + ", time", ssdo[i].milliseconds, "ms");
      }
      Result importance;
      if (Status s = run_importance(rendering, light, truth, *executor, &importance, &rgb);
          !s.ok()) {
        return s;
      }
      report->add(name, "importance", importance.error);
      report->add(name, "importance, time", importance.milliseconds, "ms");
      const std::vector<ConeEntry> cones = cone_entries(bent_falloff(rendering));
      for (std::size_t k = 0; k < cones.size(); ++k) {
        Result cone;
        if (Status s = run_cone(rendering, cones[k].settings, light, truth, *executor, &cone, &rgb);
            !s.ok()) {
          return s;
        }
        // The best that takes no longer than the cone, or the fastest.
        Result equal = ssdo[0];
        for (const Result& r : ssdo) {
          if (r.milliseconds <= cone.milliseconds && r.error < equal.error) equal = r;
        }
        report->add(name, cones[k].name, cone.error);
        report->add(name, fmt::format("{}, time", cones[k].name), cone.milliseconds, "ms");
        report->add(name, fmt::format("{} : SSDO", cones[k].name), cone.error / equal.error);
        log_ratio[k] += std::log(cone.error / equal.error);
      }
      ++count;
    }
  }
  const std::vector<ConeEntry> cones = cone_entries({});
  for (std::size_t k = 0; k < cones.size(); ++k) {
    report->add("geometric mean", fmt::format("{} : SSDO", cones[k].name),
                std::exp(log_ratio[k] / count), "", 1.0);
  }
  *text += fmt::format(
      "RMSE of linear RGB against the truth of the depth field ({} rays at every {}th pixel of "
      "{}x{}). Cones are cosine-weighted; hemisphere: 16 samples of 3 steps. SSDO NxS: N samples "
      "of "
      "S steps, each with the light of its own N-th of the hemisphere. The last columns compare at "
      "equal time: with the SSDO of the least error among those that take no longer than the cone, "
      "light included; the best of {} runs each. Importance: {} directions by the light's power, 3 "
      "steps each, 8x8 interleaved and blurred; plain loops, so its time says nothing.\n",
      kTruthRays, kEvery, kSize, kSize, kRuns, kImportanceSamples);
  return {};
}

}  // namespace obscura::tools
