#include <algorithm>
#include <filesystem>

#include "fmt/format.h"
#include "io/pictures/pictures.h"
#include "io/report/stopwatch.h"
#include "reproduce/ffao_scenes.h"
#include "reproduce/vo_scenes.h"
#include "reproduce/volumetric.h"
#include "scene/truth/geometric.h"

namespace obscura::tools {
namespace {

constexpr int kPatterns = 64;  // of the converged integral
constexpr int kRuns = 7;       // the median counts

// Median milliseconds of a frame on one thread, everything made beforehand.
Status time_frame(const DepthInput& input, const MethodSettings& settings, double* ms) {
  const DepthField field = input.field();
  Estimator estimator;
  if (Status s = Estimator::create(settings, input.width, input.height, &estimator); !s.ok()) {
    return s;
  }
  const int width = field.visible().width, height = field.visible().height;
  std::vector<float> out(static_cast<std::size_t>(width) * height);
  std::vector<double> times;
  for (int i = 0; i <= kRuns; ++i) {
    const Stopwatch watch;
    if (Status s =
            estimator.run(field, {.visibility = {out.data(), width, height}}, {.threads = 1});
        !s.ok()) {
      return s;
    }
    if (i > 0) times.push_back(1e3 * watch.seconds());  // the first touches memory anew
  }
  std::nth_element(times.begin(), times.begin() + kRuns / 2, times.end());
  *ms = times[kRuns / 2];
  return {};
}

// The scenes, and a mesh where the data are there.
std::vector<std::string> scenes_of(const std::string& data) {
  std::vector<std::string> scenes = {"cornell", "hall", "meadow"};
  std::error_code error;
  if (!data.empty() && std::filesystem::exists(data + "/meshes/kitchen.ply", error)) {
    scenes.push_back("kitchen");
  }
  return scenes;
}

// One scene with what every method is held against.
struct Subject {
  FfaoView view;
  float radius = 0;
  std::vector<float> volume, horizon;  // converged integrals
  std::vector<float> truth;            // of the real geometry, rho constant as the sphere's

  const DepthInput& input() const { return view.rendering.gbuffer; }
};

Status load_subject(const ReproduceContext& context, const std::string& scene, Executor* executor,
                    Subject* subject) {
  if (Status s = load_ffao_view(scene, context.data, {1024, 1024}, *executor, &subject->view);
      !s.ok()) {
    return s;
  }
  const float radius = static_cast<float>(0.05 * subject->input().scene_size);
  subject->radius = radius;
  if (Status s = vo_converged(subject->input(), radius, kPatterns, executor, &subject->volume);
      !s.ok()) {
    return s;
  }
  if (Status s = vo_converged_horizon(subject->input(), radius, executor, &subject->horizon);
      !s.ok()) {
    return s;
  }
  GeometricSettings rays;
  rays.falloff = {.kind = FalloffKind::kConstant, .radius = radius};
  rays.every = 8;
  subject->truth.resize(subject->volume.size());
  const Outputs outputs{.visibility = {subject->truth.data(), 1024, 1024}};
  return trace_geometric(subject->view.rendering, rays, outputs, {.executor = executor});
}

// Time and errors of one method, with and without blur; and time and error of two radii.
Status measure(const Subject& subject, const VoVariant& variant, Executor* executor, Report* report,
               std::vector<float>* v) {
  const DepthInput& input = subject.input();
  const bool is_horizon = std::holds_alternative<HorizonSettings>(variant.settings);
  const std::vector<float>& converged = is_horizon ? subject.horizon : subject.volume;
  const std::string row = subject.view.name + ", " + variant.name;
  double ms = 0;
  for (const bool blur : {true, false}) {
    const MethodSettings settings = blur ? vo_blurred(variant.settings) : variant.settings;
    if (Status s = time_frame(input, settings, &ms); !s.ok()) return s;
    if (Status s = vo_visibility(input, settings, 1, executor, v); !s.ok()) return s;
    const char* with = blur ? ", blurred" : "";
    report->add(row, fmt::format("time{}", with), ms, "ms");
    report->add(row, fmt::format("error against the converged integral{}", with),
                vo_error(input, *v, converged), "%");
    report->add(row, fmt::format("error against ray-traced{}", with),
                vo_error(input, *v, subject.truth), "%");
  }
  if (is_horizon) return {};
  MethodSettings twice = variant.settings;
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.dual; }) s.dual.second_radius = subject.radius / 4;
      },
      twice);
  std::vector<float> both;
  if (Status s = time_frame(input, twice, &ms); !s.ok()) return s;
  if (Status s = vo_visibility(input, twice, 1, executor, &both); !s.ok()) return s;
  report->add(row + ", double radius", "time", ms, "ms");
  report->add(row + ", double radius", "error against ray-traced",
              vo_error(input, both, subject.truth), "%");
  return {};
}

}  // namespace

Status reproduce_vo_table1(const ReproduceContext& context, Report* report, std::string* text) {
  const std::unique_ptr<Executor> executor = make_executor(context.threads);
  const std::vector<std::string> scenes = scenes_of(context.data);
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    Subject subject;
    if (Status s = load_subject(context, scenes[k], executor.get(), &subject); !s.ok()) return s;
    std::vector<VoVariant> variants = vo_variants(subject.radius);
    variants.push_back(vo_horizon(subject.radius));
    for (const VoVariant& variant : variants) {
      if (!context.step(scenes[k], (k + 0.5) / scenes.size())) {
        return {StatusCode::kCancelled, "stopped by the caller"};
      }
      std::vector<float> v;
      if (Status s = measure(subject, variant, executor.get(), report, &v); !s.ok()) return s;
      if (scenes[k] == "hall" && panels.size() < 4) {
        panels.push_back(
            {variant.name, grey_picture(ImageView<const float>(v.data(), 1024, 1024))});
      }
    }
  }
  if (Status s = context.picture("hall", beside(panels)); !s.ok()) return s;
  *text +=
      "One thread, 1024x1024 visible pixels and a guard band of 10 %; radius 5 % of the scene, the "
      "second a quarter of it. Times are whole frames: conversion of the input, normals, estimator "
      "and, where it says so, the blur. The converged integral is the mean of 64 reflections of 32 "
      "lines; of horizon-based ambient occlusion it is 64 directions by 64 steps. Ray-traced is "
      "the "
      "real geometry with constant falloff, which the sphere's solid half-space model differs from "
      "by design.\n";
  return {};
}

}  // namespace obscura::tools
