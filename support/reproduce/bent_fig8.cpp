// Figure 8 of bent normals and cones: light through cones against directional occlusion (SSDO),
// which looks the environment up for every sample, at equal time.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "fmt/format.h"
#include "support/pictures/pictures.h"
#include "support/reproduce/bent.h"
#include "support/reproduce/bent_scenes.h"

namespace obscura::support {
namespace {

constexpr int kSize = 1024, kEvery = 16, kTruthRays = 4096, kRuns = 3;
constexpr int kConeSamples = 16, kSteps = 3;
constexpr int kSsdoSamples[] = {8, 12, 16, 20};

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// What a sample of SSDO stands for: light within a cone of a `samples`-th of the hemisphere.
std::array<float, 3> sample_light(const NamedLight& light, const std::array<float, 9>& m,
                                  int samples, const std::array<float, 3>& w) {
  const double cosine = 1 - 1.0 / samples;
  std::array<float, 3> d;
  for (int k = 0; k < 3; ++k) d[k] = m[3 * k] * w[0] + m[3 * k + 1] * w[1] + m[3 * k + 2] * w[2];
  std::array<float, 3> c = light.convolved.radiance(d, static_cast<float>(std::acos(cosine)));
  const Sun& sun = light.environment.sun();
  if (sun.shines() &&
      d[0] * sun.direction[0] + d[1] * sun.direction[1] + d[2] * sun.direction[2] > cosine) {
    const double spread = 3.14159265358979 * (1 - cosine * cosine);
    for (int k = 0; k < 3; ++k) c[k] += static_cast<float>(sun.irradiance[k] / spread);
  }
  return c;
}

struct Result {
  double milliseconds = 0, error = 0;
};

Status run_cone(const Rendering& rendering, const NamedLight& light, const Image& truth,
                Executor& executor, Result* result, Image* rgb) {
  const DepthField field = rendering.gbuffer.field();
  const HemisphereSettings settings{
      .falloff = bent_falloff(rendering), .samples = kConeSamples, .steps = kSteps};
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, 0, &estimator);
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
                int samples, Executor& executor, Result* result, Image* rgb) {
  const DepthField field = rendering.gbuffer.field();
  HemisphereSettings settings{
      .falloff = bent_falloff(rendering), .samples = samples, .steps = kSteps};
  const std::array<float, 9> m = world_from_eye(rendering);
  settings.radiance = [&](const std::array<float, 3>& w) {
    return sample_light(light, m, samples, w);
  };
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, 0, &estimator);
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

}  // namespace

Status reproduce_bent_fig8(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  std::vector<NamedLight> lights;
  if (Status s = bent_lights(context.data, *executor, &lights); !s.ok()) return s;
  double log_ratio = 0, done = 0;
  int count = 0;
  for (const std::string& scene : bent_scenes()) {
    Rendering rendering;
    if (Status s = load_bent_scene(scene, kSize, *executor, &rendering); !s.ok()) return s;
    for (const NamedLight& light : lights) {
      if (!context.step(scene, done++ / static_cast<double>(4 * lights.size()))) {
        return {StatusCode::kCancelled, "stopped by the user"};
      }
      Image truth, cone_rgb, rgb;
      if (Status s = lit_truth(rendering, light.environment, kTruthRays, kEvery, *executor, &truth);
          !s.ok()) {
        return s;
      }
      const std::string name = scene + ", " + light.name;
      Result cone;
      if (Status s = run_cone(rendering, light, truth, *executor, &cone, &cone_rgb); !s.ok()) {
        return s;
      }
      report->add(name, "cone", cone.error);
      report->add(name, "cone's time", cone.milliseconds, "ms");
      // The slowest that takes no longer than the cone, or the fastest.
      Result equal;
      for (int samples : kSsdoSamples) {
        Result ssdo;
        if (Status s = run_ssdo(rendering, light, truth, samples, *executor, &ssdo, &rgb);
            !s.ok()) {
          return s;
        }
        report->add(name, fmt::format("SSDO {}", samples), ssdo.error);
        report->add(name, fmt::format("time {}", samples), ssdo.milliseconds, "ms");
        if (samples == kSsdoSamples[0] || ssdo.milliseconds <= cone.milliseconds) equal = ssdo;
      }
      report->add(name, "cone : SSDO at equal time", cone.error / equal.error);
      log_ratio += std::log(cone.error / equal.error);
      ++count;
    }
  }
  report->add("geometric mean", "cone : SSDO at equal time", std::exp(log_ratio / count), "", 1.0);
  *text += fmt::format(
      "RMSE of linear RGB against the truth of the depth field ({} rays at every {}th pixel of "
      "{}x{}). Cone: {} samples of {} steps, cosine-weighted. SSDO N: N samples of as many steps, "
      "each with the light of its own N-th of the hemisphere. Equal time: the largest N that takes "
      "no longer than the cone, light included; the best of {} runs each.\n",
      kTruthRays, kEvery, kSize, kSize, kConeSamples, kSteps, kRuns);
  return {};
}

}  // namespace obscura::support
