#include "reproduce/ffao_scenes.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>

#include "io/images/files.h"
#include "scene/scenes/mesh_view.h"
#include "scene/truth/geometric.h"

namespace obscura::tools {
namespace {

std::string kitchen_of(const std::string& data) { return data + "/meshes/kitchen.ply"; }

// Into the corner with the table, past the block in the middle.
Status load_kitchen(const std::string& data, ImageSize size, Executor& executor,
                    Rendering* rendering) {
  MeshOptions options;
  options.view.size = size;
  options.view.eye = Vec3{1.2, 1.6, 3.5};
  options.view.look_at = Vec3{-0.3, 1.1, 0};
  options.view.fov_y = 60;
  options.view.back_depth = true;
  return load_mesh(kitchen_of(data), options, executor, rendering);
}

Status load_bunny(const std::string& data, ImageSize size, Executor& executor,
                  Rendering* rendering) {
  MeshOptions options;
  options.view.size = size;
  options.view.back_depth = true;
  options.ground = true;
  return load_mesh(data + "/meshes/stanford-bunny.obj", options, executor, rendering);
}

Outputs visibility_to(const FfaoView& view, std::vector<float>* result) {
  result->resize(static_cast<std::size_t>(view.width) * view.height);
  Outputs outputs;
  outputs.visibility = {result->data(), view.width, view.height};
  return outputs;
}

}  // namespace

std::vector<std::string> ffao_scenes(const std::string& data) {
  std::vector<std::string> names = {"hall", "meadow"};
  std::error_code error;
  if (!data.empty() && std::filesystem::exists(kitchen_of(data), error)) names.push_back("kitchen");
  return names;
}

Status load_ffao_view(const std::string& name, const std::string& data, ImageSize size,
                      Executor& executor, FfaoView* view) {
  view->name = name;
  view->width = size.width;
  view->height = size.height;
  Status s;
  if (name == "kitchen") {
    s = load_kitchen(data, size, executor, &view->rendering);
  } else if (name == "bunny") {
    s = load_bunny(data, size, executor, &view->rendering);
  } else {
    ViewOptions options;
    options.size = size;
    options.back_depth = true;
    s = load_scene("scene:" + name, options, executor, &view->rendering);
  }
  const double share = name == "hall" || name == "kitchen" ? 0.1 : name == "meadow" ? 0.04 : 0.05;
  view->falloff.radius = static_cast<float>(share * view->rendering.gbuffer.scene_size);
  return s;
}

Status load_ffao_depth(const std::string& name, const std::string& data, FfaoView* view,
                       std::vector<float>* truth) {
  Image depth, known;
  const std::string stem = data + "/depth/" + name;
  if (Status s = read_image(stem + ".pfm", &depth); !s.ok()) return s;
  if (Status s = read_image(stem + ".truth.pfm", &known); !s.ok()) return s;
  DepthInput& in = view->rendering.gbuffer;
  in.width = depth.width;
  in.height = depth.height;
  in.depth = depth.channels[0].values;
  in.guard_band = GuardBand::symmetric(64, 36);
  in.camera.scale_x = in.camera.scale_y = 1 / 311.769f;
  in.camera.center_u = 0.5f * static_cast<float>(in.width);
  in.camera.center_v = 0.5f * static_cast<float>(in.height);
  view->name = "depth/" + name;
  view->falloff.radius = name == "hall" ? 2.0f : name == "spheres" ? 1.0f : 0.7f;
  view->width = in.width - 128;
  view->height = in.height - 72;
  *truth = known.channels[0].values;
  return {};
}

double FfaoRun::pass(const std::string& name) const {
  for (const PassTime& t : pass_times) {
    if (name == t.name) return t.milliseconds;
  }
  return 0;
}

Status run_ffao(const FfaoView& view, const MethodSettings& settings, Executor& executor,
                FfaoRun* run, int count) {
  const DepthField field = view.rendering.gbuffer.field();
  const Outputs outputs = visibility_to(view, &run->visibility);
  Estimator estimator;
  if (Status s = Estimator::create(settings, field.depth.width, field.depth.height, &estimator);
      !s.ok()) {
    return s;
  }
  struct Timed {
    double milliseconds;
    std::vector<PassTime> passes;
  };
  std::vector<Timed> runs;
  std::clock_t processor = 0;
  for (int i = 0; i <= count; ++i) {
    Timed timed{};
    RunOptions options;
    options.executor = &executor;
    options.pass_times = &timed.passes;
    if (i == 1) processor = std::clock();
    const auto start = std::chrono::steady_clock::now();
    if (Status s = estimator.run(field, outputs, options); !s.ok()) return s;
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    timed.milliseconds = time.count();
    if (i > 0) runs.push_back(std::move(timed));
  }
  run->processor_ms = 1e3 * static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC / count;
  std::nth_element(runs.begin(), runs.begin() + count / 2, runs.end(),
                   [](const Timed& a, const Timed& b) { return a.milliseconds < b.milliseconds; });
  run->milliseconds = runs[count / 2].milliseconds;
  run->pass_times = runs[count / 2].passes;
  return {};
}

Status trace_depth_field(const FfaoView& view, const TruthGrid& grid, Executor& executor,
                         std::vector<float>* truth, const Occluder& occluder) {
  ReferenceSettings settings = tracer_for(view, grid.rays);
  settings.occluder = occluder;
  settings.seed = 1;
  settings.every = grid.every;
  RunOptions options;
  options.executor = &executor;
  return compute(view.rendering.gbuffer.field(), settings, visibility_to(view, truth), options);
}

Status trace_world(const FfaoView& view, const TruthGrid& grid, Executor& executor,
                   std::vector<float>* truth) {
  GeometricSettings settings;
  settings.falloff = view.falloff;
  settings.rays = grid.rays;
  settings.every = grid.every;
  RunOptions options;
  options.executor = &executor;
  return trace_geometric(view.rendering, settings, visibility_to(view, truth), options);
}

Status compare_ffao(const FfaoView& view, const std::vector<float>& visibility,
                    const std::vector<float>& truth, Comparison* result) {
  const DepthField field = view.rendering.gbuffer.field();
  const ImageView<const float>& d = field.depth;
  const ImageView<const float> depth(&d(field.guard_band.left, field.guard_band.top), view.width,
                                     view.height, d.row_stride, d.pixel_stride);
  int width = view.width, height = view.height;
  if (truth.size() < visibility.size()) width /= kSubset.every, height /= kSubset.every;
  return compare({visibility.data(), view.width, view.height}, {truth.data(), width, height}, depth,
                 result);
}

FarFieldSettings far_field_for(const FfaoView& view, int directions, int segments) {
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.falloff = view.falloff;
  s.directions = directions;
  s.segments = segments;
  return s;
}
FarFieldSettings far_field_for(const FfaoView& view, FarFieldPreset preset) {
  FarFieldSettings s{.occluder = Occluder::solid()};
  s.falloff = view.falloff;
  s.preset = preset;
  return s;
}
FarFieldSettings far_field_of_the_paper(const FfaoView& view, int directions) {
  FarFieldSettings s = far_field_for(view, directions, 2);
  s.profile = SlabProfile::kSlab;
  s.receiver_slope = -1;
  s.near_step = NearStep::of(1);
  return s;
}
MipmapSettings mipmap_for(const FfaoView& view, int directions) {
  MipmapSettings s;
  s.falloff = view.falloff;
  s.directions = directions;
  return s;
}
ReferenceSettings tracer_for(const FfaoView& view, int rays) {
  ReferenceSettings s{.occluder = Occluder::solid()};
  s.falloff = view.falloff;
  s.rays = rays;
  s.seed = 2;  // not the truth's
  return s;
}

Status stopped() { return {StatusCode::kCancelled, "stopped by the user"}; }

}  // namespace obscura::tools
