#include <utility>

#include "fmt/format.h"
#include "io/pictures/plot.h"
#include "reproduce/far_field.h"
#include "reproduce/ffao_scenes.h"

namespace obscura::tools {
namespace {

// One point of a method's curve.
struct Candidate {
  std::string series, settings_text;
  MethodSettings settings;
};

void add_far_field(const FfaoView& view, const std::string& series, const Occluder& occluder,
                   std::vector<Candidate>* out) {
  for (const auto preset :
       {FarFieldPreset::kFast, FarFieldPreset::kBalanced, FarFieldPreset::kHigh}) {
    FarFieldSettings s = far_field_for(view, preset);
    s.occluder = occluder;
    out->push_back({series, EnumNames<FarFieldPreset>::names[static_cast<int>(preset)], s});
  }
}

std::vector<Candidate> candidates(const FfaoView& view) {
  std::vector<Candidate> out;
  const float thickness = static_cast<float>(0.01 * view.rendering.gbuffer.scene_size);
  add_far_field(view, "far field", {}, &out);
  add_far_field(view, "far field, thickness 1 %", Occluder::of_thickness(thickness), &out);
  add_far_field(view, "far field, back depth", Occluder::back_depth(), &out);
  for (const int k : {4, 8, 16, 32}) {
    out.push_back({"mipmap", fmt::format("K = {}", k), mipmap_for(view, k)});
  }
  for (const auto variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    for (const auto& [k, steps] : {std::pair{4, 8}, std::pair{8, 16}, std::pair{16, 32}}) {
      HorizonSettings s{.occluder = Occluder::solid()};
      s.falloff = view.falloff;
      s.variant = variant;
      s.directions = k;
      s.steps = steps;
      out.push_back({fmt::format("horizon, {}", write_setting(variant)),
                     fmt::format("{} x {}", k, steps), s});
    }
  }
  // Volumetric obscurance answers another question, with a radius of its own: the best of three.
  for (const double scale : {0.5, 1.0, 2.0}) {
    for (const int lines : {5, 9}) {
      LineSettings s;
      s.falloff.radius = static_cast<float>(scale * view.falloff.radius);
      s.samples = lines;
      out.push_back({fmt::format("line, radius {:g} R", scale), fmt::format("{}", lines), s});
    }
  }
  for (const int rays : {1, 4, 16, 64}) {
    out.push_back({"ray-traced", fmt::format("{} rays", rays), tracer_for(view, rays)});
  }
  return out;
}

}  // namespace

Status reproduce_error_vs_time(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  const std::vector<std::string> scenes = ffao_scenes(context.data);
  double done = 0;
  for (const std::string& scene : scenes) {
    if (!context.step(scene + ": truths", done)) return stopped();
    FfaoView view;
    if (Status s = load_ffao_view(scene, context.data, {640, 360}, *executor, &view); !s.ok()) {
      return s;
    }
    std::vector<float> truths[2];
    if (Status s = trace_depth_field(view, kSubset, *executor, &truths[0]); !s.ok()) return s;
    if (Status s = trace_world(view, kSubset, *executor, &truths[1]); !s.ok()) return s;
    constexpr const char* kTruths[] = {"solid depth field", "real geometry"};
    Plot plots[2];
    for (int i = 0; i < 2; ++i) {
      plots[i].title = fmt::format("{}, truth: {}", scene, kTruths[i]);
      plots[i].x_label = "ms";
      plots[i].y_label = "e_A, %";
    }
    const std::vector<Candidate> all = candidates(view);
    for (const Candidate& candidate : all) {
      done += 1.0 / static_cast<double>(all.size() * scenes.size());
      if (!context.step(fmt::format("{}: {}", scene, candidate.series), done)) return stopped();
      FfaoRun run;
      if (Status s = run_ffao(view, candidate.settings, *executor, &run); !s.ok()) return s;
      const std::string row =
          fmt::format("{}: {}, {}", scene, candidate.series, candidate.settings_text);
      report->add(row, "time", run.milliseconds, "ms");
      for (int i = 0; i < 2; ++i) {
        Comparison c;
        if (Status s = compare_ffao(view, run.visibility, truths[i], &c); !s.ok()) return s;
        report->add(row, fmt::format("e_A, {}", kTruths[i]), c.e_a, "%");
        auto& series = plots[i].series;
        if (series.empty() || series.back().name != candidate.series) {
          series.emplace_back();
          series.back().name = candidate.series;
        }
        series.back().points.emplace_back(run.milliseconds, c.e_a);
      }
    }
    for (int i = 0; i < 2; ++i) {
      const std::string what = fmt::format("{}-{}", scene, i == 0 ? "solid" : "geometric");
      if (Status s = context.plot(what, plots[i].to_svg()); !s.ok()) return s;
    }
  }
  *text =
      "640x360 with a guard band of 10 %; truths at every fifth pixel, 4,096 rays. Far field: "
      "presets "
      "fast, balanced, high. Line sampling is volumetric obscurance, an integral of its own, with "
      "three radii around the falloff's length R.\n";
  return {};
}

}  // namespace obscura::tools
