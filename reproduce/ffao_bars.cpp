// Regression thresholds of the far field, each figure beside its threshold.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "fmt/format.h"
#include "reproduce/far_field.h"
#include "reproduce/ffao_scenes.h"

namespace obscura::tools {
namespace {

constexpr ImageSize kSmall{640, 360}, kLarge{1280, 720}, kHuge{3840, 2160};
constexpr float kInf = std::numeric_limits<float>::infinity();

struct Bench {
  const ReproduceContext& context;
  Executor& executor;
  Report* report;

  // A figure and, where it is held against one, its bar.
  void add(const std::string& name, double value, const std::string& unit,
           std::optional<double> bar = {}) const {
    const std::string row = unit.empty() ? name : fmt::format("{}, {}", name, unit);
    report->add(row, "figure", value, "", bar);
    if (bar) report->add(row, "bar", *bar);
  }

  Status load(const std::string& name, ImageSize size, FfaoView* view) const {
    return load_ffao_view(name, context.data, size, executor, view);
  }
  // Times are processor time, where both sides of a ratio use the same threads.
  Status error(const FfaoView& view, const MethodSettings& settings,
               const std::vector<float>& truth, Comparison* c, double* milliseconds = nullptr,
               int runs = 1) const {
    FfaoRun run;
    if (Status s = run_ffao(view, settings, executor, &run, runs); !s.ok()) return s;
    if (milliseconds) *milliseconds = run.processor_ms;
    return compare_ffao(view, run.visibility, truth, c);
  }
  bool has(const char* file) const {
    std::error_code error;
    return !context.data.empty() && std::filesystem::exists(context.data + "/" + file, error);
  }
};

// Default settings against the truth of the depth field.
Status default_errors(const Bench& b, const FfaoView& view, const std::vector<float>& truth,
                      double e_a, double within_5) {
  Comparison c;
  if (Status s = b.error(view, far_field_for(view, 16, 2), truth, &c); !s.ok()) return s;
  b.add(view.name + ", default: e_A", c.e_a, "%", e_a);
  b.add(view.name + ", default: e_<5%", c.within_5, "%", within_5);
  return {};
}

Status slab_errors(const Bench& b, const FfaoView& view, const std::vector<float>& truth) {
  Comparison slab, chord;
  if (Status s = b.error(view, far_field_of_the_paper(view, 16), truth, &slab); !s.ok()) return s;
  if (Status s = b.error(view, far_field_for(view, 16, 2), truth, &chord); !s.ok()) return s;
  b.add(view.name + ", slab: e_A", slab.e_a, "%");
  b.add(view.name + ", slab: bias, positive", slab.bias, "%");
  b.add(view.name + ", default / slab: e_A", chord.e_a / slab.e_a, "", 0.5);
  return {};
}

Status depth_field_errors(const Bench& b) {
  FfaoView view;
  std::vector<float> truth;
  for (const auto& [name, e_a, within_5] :
       {std::tuple{"hall", 1.2, 98.5}, std::tuple{"meadow", 1.1, 97.0}}) {
    if (Status s = b.load(name, kSmall, &view); !s.ok()) return s;
    if (Status s = trace_depth_field(view, kSubset, b.executor, &truth); !s.ok()) return s;
    if (Status s = default_errors(b, view, truth, e_a, within_5); !s.ok()) return s;
    if (std::string(name) != "hall") continue;
    if (Status s = slab_errors(b, view, truth); !s.ok()) return s;
    view.falloff.radius = kInf;
    view.name = "hall, endless";
    if (Status s = trace_depth_field(view, kSubset, b.executor, &truth); !s.ok()) return s;
    if (Status s = default_errors(b, view, truth, 0.7, 98.5); !s.ok()) return s;
  }
  if (!b.has("depth")) return {};
  for (const auto& [name, e_a, within_5] :
       {std::tuple{"hall", 0.84, 98.5}, std::tuple{"spheres", 0.53, 98.5},
        std::tuple{"terrain", 1.12, 91.0}}) {
    FfaoView image;
    if (Status s = load_ffao_depth(name, b.context.data, &image, &truth); !s.ok()) return s;
    if (Status s = default_errors(b, image, truth, e_a, within_5); !s.ok()) return s;
    if (std::string(name) != "hall") continue;
    if (Status s = slab_errors(b, image, truth); !s.ok()) return s;
  }
  return {};
}

// Models of thickness against the real geometry.
Status world_errors(const Bench& b) {
  std::vector<const char*> scenes = {"hall", "tower", "cornell"};
  if (b.has("meshes/stanford-bunny.obj")) scenes.push_back("bunny");
  double mean[6] = {};  // of the far field, of rays through the same model
  for (const char* scene : scenes) {
    FfaoView view;
    if (Status s = b.load(scene, kSmall, &view); !s.ok()) return s;
    const double size = view.rendering.gbuffer.scene_size;
    view.falloff.radius = static_cast<float>(0.05 * size);
    std::vector<float> truth, traced;
    if (Status s = trace_world(view, kSubset, b.executor, &truth); !s.ok()) return s;
    const std::pair<const char*, Occluder> models[] = {
        {"solid", {}},
        {"thickness 1 %", Occluder::of_thickness(static_cast<float>(0.01 * size))},
        {"back depth", Occluder::back_depth()}};
    for (int i = 0; i < 3; ++i) {
      FarFieldSettings settings = far_field_for(view, 16, 2);
      settings.near_step = NearStep::of(0.25f);
      settings.occluder = models[i].second;
      Comparison c;
      if (Status s = b.error(view, settings, truth, &c); !s.ok()) return s;
      b.add(fmt::format("{} against the real geometry, {}: e_A", scene, models[i].first), c.e_a,
            "%");
      mean[i] += c.e_a / static_cast<double>(scenes.size());
      if (Status s = trace_depth_field(view, kSubset, b.executor, &traced, models[i].second);
          !s.ok()) {
        return s;
      }
      if (Status s = compare_ffao(view, traced, truth, &c); !s.ok()) return s;
      b.add(fmt::format("{} against the real geometry, {}, traced: e_A", scene, models[i].first),
            c.e_a, "%");
      mean[3 + i] += c.e_a / static_cast<double>(scenes.size());
    }
  }
  b.add("mean against the real geometry, solid: e_A", mean[0], "%");
  b.add("mean against the real geometry, solid, traced: e_A", mean[3], "%");
  b.add("mean against the real geometry, thickness 1 %, traced: e_A", mean[4], "%");
  b.add("mean against the real geometry, back depth, traced: e_A", mean[5], "%");
  b.add("mean against the real geometry, thickness 1 %: e_A", mean[1], "%",
        std::min(3.5, 0.5 * mean[0]));
  b.add("mean against the real geometry, back depth: e_A", mean[2], "%",
        std::min(2.5, 0.5 * mean[0]));
  return {};
}

// A rival's settings with what they cost and how close they come.
struct Point {
  double milliseconds, e_a;
};
Status rival_points(const Bench& b, const FfaoView& view, const std::vector<float>& truth,
                    const std::vector<MethodSettings>& settings, std::vector<Point>* points) {
  for (const MethodSettings& m : settings) {
    Point p{};
    Comparison c;
    if (Status s = b.error(view, m, truth, &c, &p.milliseconds, 3); !s.ok()) return s;
    p.e_a = c.e_a;
    points->push_back(p);
  }
  return {};
}
double least_error(const std::vector<Point>& points, double milliseconds) {
  double least = kInf;
  for (const Point& p : points) {
    if (p.milliseconds <= 1.05 * milliseconds) least = std::min(least, p.e_a);
  }
  return least;
}

std::vector<MethodSettings> mipmaps(const FfaoView& view) {
  std::vector<MethodSettings> all;
  for (const int k : {4, 6, 8, 12, 16, 24, 32, 64}) {
    for (const float factor : {1.25f, 1.5f, 2.0f}) {
      MipmapSettings s = mipmap_for(view, k);
      s.step_factor = factor;
      all.push_back(s);
    }
  }
  return all;
}
std::vector<MethodSettings> horizons(const FfaoView& view) {
  std::vector<MethodSettings> all;
  for (const HorizonVariant variant : {HorizonVariant::kSlices, HorizonVariant::kClassic}) {
    for (const int k : {4, 8, 16, 32}) {
      for (const int steps : {4, 8, 16, 32, 64}) {
        HorizonSettings s{.occluder = Occluder::solid()};
        s.falloff = view.falloff;
        s.variant = variant;
        s.directions = k;
        s.steps = steps;
        all.push_back(s);
      }
    }
  }
  return all;
}

Status at_equal_time(const Bench& b) {
  for (const char* scene : {"hall", "meadow"}) {
    FfaoView view;
    std::vector<float> truth;
    if (Status s = b.load(scene, kSmall, &view); !s.ok()) return s;
    if (Status s = trace_depth_field(view, kSubset, b.executor, &truth); !s.ok()) return s;
    std::vector<Point> mipmap, horizon;
    if (Status s = rival_points(b, view, truth, mipmaps(view), &mipmap); !s.ok()) return s;
    if (Status s = rival_points(b, view, truth, horizons(view), &horizon); !s.ok()) return s;
    for (const auto preset :
         {FarFieldPreset::kFast, FarFieldPreset::kBalanced, FarFieldPreset::kHigh}) {
      Comparison c;
      double ms = 0;
      if (Status s = b.error(view, far_field_for(view, preset), truth, &c, &ms, 3); !s.ok()) {
        return s;
      }
      const std::string row =
          fmt::format("{}, {} ({:.0f} ms, e_A {:.2f} %)", scene, write_setting(preset), ms, c.e_a);
      b.add(row + ": e_A / mipmap's", c.e_a / least_error(mipmap, ms), "", 0.4);
      b.add(row + ": e_A / the better horizon's", c.e_a / least_error(horizon, ms), "", 0.5);
    }
  }
  return {};
}

// Rays that the tracer needs for the same error: its error falls along a line between powers of two
// on a doubly logarithmic scale.
Status against_the_tracer(const Bench& b) {
  for (const char* scene : {"hall", "meadow"}) {
    FfaoView view;
    std::vector<float> truth;
    if (Status s = b.load(scene, kSmall, &view); !s.ok()) return s;
    if (Status s = trace_depth_field(view, kSubset, b.executor, &truth); !s.ok()) return s;
    Comparison ours;
    double ms = 0;
    const MethodSettings balanced = far_field_for(view, FarFieldPreset::kBalanced);
    if (Status s = b.error(view, balanced, truth, &ours, &ms, 3); !s.ok()) return s;
    Point last{};
    for (int rays = 1; rays <= 256; rays *= 2) {
      Comparison c;
      Point p{};
      if (Status s = b.error(view, tracer_for(view, rays), truth, &c, &p.milliseconds); !s.ok()) {
        return s;
      }
      p.e_a = c.e_a;
      if (p.e_a <= ours.e_a) {
        const double t = rays == 1 ? 1 : std::log(last.e_a / ours.e_a) / std::log(last.e_a / p.e_a);
        const double time =
            rays == 1 ? p.milliseconds
                      : last.milliseconds * std::pow(p.milliseconds / last.milliseconds, t);
        const double equal = rays == 1 ? 1 : rays / 2 * std::pow(2.0, t);
        b.add(fmt::format("{}, tracer with {:.1f} rays / balanced: time at e_A {:.2f} %", scene,
                          equal, ours.e_a),
              time / ms, "", 30);
        break;
      }
      last = p;
    }
  }
  return {};
}

Status times(const Bench& b) {
  FfaoView view, huge;
  if (Status s = b.load("hall", kLarge, &view); !s.ok()) return s;
  if (Status s = b.load("hall", kHuge, &huge); !s.ok()) return s;
  const auto one = make_executor(1), two = make_executor(2);
  auto time = [&](const FfaoView& v, const FarFieldSettings& settings, Executor& executor,
                  FfaoRun* run) { return run_ffao(v, settings, executor, run, 5); };
  FarFieldSettings far = far_field_for(view, 8, 2);
  far.near_field = false;
  FfaoRun small, single, large, near_radius, far_radius, balanced;
  if (Status s = time(view, far, *two, &small); !s.ok()) return s;
  if (Status s = time(view, far, *one, &single); !s.ok()) return s;
  if (Status s = time(huge, far, *two, &large); !s.ok()) return s;
  far.falloff.radius = 0.1f;
  if (Status s = time(view, far, *two, &near_radius); !s.ok()) return s;
  far.falloff.radius = 1000;
  if (Status s = time(view, far, *two, &far_radius); !s.ok()) return s;
  if (Status s = time(view, far_field_for(view, FarFieldPreset::kBalanced), *two, &balanced);
      !s.ok()) {
    return s;
  }
  b.add("1280x720, two threads, far field alone, 8x2", small.milliseconds, "ms", 250);
  b.add("1280x720, two threads, balanced", balanced.milliseconds, "ms", 450);
  b.add("one thread / two threads", single.milliseconds / small.milliseconds, "", 1.8);
  b.add("radius 1000 / radius 0.1: time", far_radius.processor_ms / near_radius.processor_ms, "",
        1.05);
  b.add("2160p / 720p: time per pixel", large.processor_ms / small.processor_ms / 9, "", 1.3);
  return {};
}

}  // namespace

Status reproduce_ffao_bars(const ReproduceContext& context, Report* report, std::string* text) {
  const auto executor = make_executor(context.threads);
  const Bench bench{context, *executor, report};
  const std::pair<const char*, Status (*)(const Bench&)> parts[] = {
      {"errors against the depth field", depth_field_errors},
      {"errors against the real geometry", world_errors},
      {"equal time", at_equal_time},
      {"the tracer", against_the_tracer},
      {"times", times}};
  double done = 0;
  for (const auto& [name, measure] : parts) {
    if (!context.step(name, done)) return stopped();
    done += 1.0 / std::size(parts);
    if (Status s = measure(bench); !s.ok()) return s;
  }
  *text =
      "Errors at 640x360 with a guard band of 10 %. Rivals at equal time: the best of their "
      "settings "
      "that take at most 5 % longer. Bytes of intermediate data: obscura bench "
      "--benchmark_filter=far_field_scan.\n";
  return {};
}

}  // namespace obscura::tools
