// Bent normals and cones (Klehm et al. 2011, section 5): what directions cost beside visibility
// alone.
#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "fmt/format.h"
#include "reproduce/bent.h"
#include "reproduce/bent_scenes.h"

namespace obscura::tools {
namespace {

constexpr int kSize = 1024, kRuns = 12, kFarFieldRuns = 5;  // the far field takes long

// One estimator with and without directions; runs of both take turns, so that what else the machine
// does meets them alike; the fastest of each pass counts, which was the least disturbed.
struct Timing {
  double plain[2] = {}, bent[2] = {};  // ms: samples, blur
};
Status time_method(const Rendering& rendering, const MethodSettings& settings, Executor& executor,
                   Timing* timing) {
  const DepthField field = rendering.gbuffer.field();
  BentBuffers buffers(rendering.view.width, rendering.view.height);
  Outputs bent, plain;
  bent.visibility = plain.visibility = buffers.visibility;
  bent.bent_normal = buffers.bent;
  bent.cone_angle = buffers.angle;
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, &estimator);
      !s.ok()) {
    return s;
  }
  std::vector<PassTime> passes;
  RunOptions options;
  options.executor = &executor;
  options.pass_times = &passes;
  std::vector<double> times[2][2];
  const int runs = std::holds_alternative<FarFieldSettings>(settings) ? kFarFieldRuns : kRuns;
  for (int run = 0; run <= runs; ++run) {
    for (const bool directions : {false, true}) {
      if (Status s = estimator.run(field, directions ? bent : plain, options); !s.ok()) return s;
      if (run == 0) continue;  // warms up
      double spent[2] = {};
      for (const PassTime& p : passes) {
        const std::string_view name = p.name;
        if (name != "convert") spent[name == "blur"] += p.milliseconds;
      }
      for (int i = 0; i < 2; ++i) times[directions][i].push_back(spent[i]);
    }
  }
  for (int i = 0; i < 2; ++i) {
    timing->plain[i] = *std::min_element(times[0][i].begin(), times[0][i].end());
    timing->bent[i] = *std::min_element(times[1][i].begin(), times[1][i].end());
  }
  return {};
}

std::vector<std::pair<const char*, MethodSettings>> methods(const Rendering& rendering) {
  const Falloff falloff = bent_falloff(rendering);
  PointSettings crytek2d;
  crytek2d.falloff = falloff;
  crytek2d.pattern = PointPattern::kScreen;
  crytek2d.samples = 16;
  HemisphereSettings crytek3d{.occluder = Occluder::solid()};
  crytek3d.falloff = falloff;
  crytek3d.weighting = RayWeighting::kUniform;
  HorizonSettings hbao{.occluder = Occluder::solid()};
  hbao.falloff = falloff;
  hbao.directions = hbao.steps = 8;
  hbao.variant = HorizonVariant::kClassic;
  HorizonSettings slices = hbao;
  slices.variant = HorizonVariant::kSlices;
  FarFieldSettings far_field{.occluder = Occluder::solid()}, fast = far_field;
  far_field.falloff = fast.falloff = falloff;
  fast.preset = FarFieldPreset::kFast;
  return {{"Crytek2D, 16 samples", crytek2d},    {"Crytek3D, 8 samples, 3 steps", crytek3d},
          {"HBAO, 8 directions, 8 steps", hbao}, {"horizon slices, 8 directions, 8 steps", slices},
          {"far field, preset fast", fast},      {"far field", far_field}};
}

}  // namespace

Status reproduce_bent_overhead(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  double done = 0;
  for (const std::string& scene : bent_scenes()) {
    Rendering rendering;
    if (Status s = load_bent_scene(scene, kSize, *executor, &rendering); !s.ok()) return s;
    for (const auto& [method, settings] : methods(rendering)) {
      if (!context.step(scene, done++ / 24)) {
        return {StatusCode::kCancelled, "stopped by the user"};
      }
      Timing t;
      if (Status s = time_method(rendering, settings, *executor, &t); !s.ok()) return s;
      const std::string name = fmt::format("{}, {}", scene, method);
      report->add(name, "samples", t.plain[0], "ms");
      report->add(name, "blur", t.plain[1], "ms");
      report->add(name, "directions add", 100 * (t.bent[0] / t.plain[0] - 1), "%", 7);
      if (t.plain[1] > 0) {
        report->add(name, "to the blur", 100 * (t.bent[1] / t.plain[1] - 1), "%", 25);
      }
      report->add(name, "in all", 100 * ((t.bent[0] + t.bent[1]) / (t.plain[0] + t.plain[1]) - 1),
                  "%", 11);
    }
  }
  *text += fmt::format(
      "{}x{}, {} threads; the fastest of {} runs ({} of the far field) with and without directions "
      "in turn. The blur "
      "writes "
      "the results, so that normalising directions and cones counts there. The paper reports 7 % "
      "for the samples, 25 % for the blur and less than 11 % in all.\n",
      kSize, kSize, executor->thread_count(), kRuns, kFarFieldRuns);
  return {};
}

}  // namespace obscura::tools
