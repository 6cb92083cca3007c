// obscura demo: two scenes, each by a fast method and by ray tracing, and the difference between
// them.
#include <filesystem>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/methods.h"
#include "apps/obscura/output.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/pictures/pictures.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"
#include "scene/scenes/load_scene.h"
#include "scene/truth/compare.h"

namespace obscura::app {
namespace {

constexpr int kTruthRays = 64;

struct DemoCommand {
  std::string folder = "demo", json, size = "640x360";
  int threads = 0;
};

// Visibility of an input by one method, and the seconds it took.
struct Run {
  tools::Image image;
  double seconds = 0;

  ImageView<const float> view() const { return image.view(0); }
};

Status run_timed(const std::string& label, const AnySettings& settings, const LoadedInput& input,
                 int threads, bool quiet, Run* run) {
  const DepthField field = input.field();
  run->image = tools::Image(field.visible().width, field.visible().height);
  run->image.add("visibility");
  tools::ProgressBar bar(label, !quiet);
  const tools::Stopwatch watch;
  MadeOnce once;
  const Status status = run_method(
      settings, input, {.visibility = run->image.view(0)},
      {.threads = threads, .progress = [&bar](double share) { return bar(share); }}, &once);
  run->seconds = watch.seconds();
  return status;
}

// The pictures say nothing of times, which depend on the machine.
Status write_pictures(const DemoCommand& c, const std::string& name, const DepthField& field,
                      const Run& method, const Run& traced_run, const Run& world_run) {
  auto visible = [&](const ImageView<const float>& v) {
    return ImageView<const float>(&v(field.guard_band.left, field.guard_band.top),
                                  field.visible().width, field.visible().height, v.row_stride);
  };
  const auto mask = visible(field.depth);
  const tools::Image depth = tools::depth_picture(mask);
  const tools::Image normals = tools::vector_picture(
      {visible(field.normals.x), visible(field.normals.y), visible(field.normals.z)});
  const tools::Image fast = tools::grey_picture(method.view());
  const tools::Image traced = tools::grey_picture(traced_run.view());
  const tools::Image world = tools::grey_picture(world_run.view());
  const tools::Image error = tools::error_picture(method.view(), world_run.view(), mask);
  const tools::Image comparison =
      tools::beside({{kDefaultMethod, fast},
                     {fmt::format("rays in the depth image, {} per pixel", kTruthRays), traced},
                     {fmt::format("rays in the scene, {} per pixel", kTruthRays), world},
                     {"difference to the scene: white 0 %, black 20 % and more", error}});
  const std::pair<const char*, const tools::Image*> pictures[] = {
      {"depth", &depth}, {"normals", &normals}, {"visibility", &fast},      {"truth", &traced},
      {"world", &world}, {"error", &error},     {"comparison", &comparison}};
  for (const auto& [what, picture] : pictures) {
    const std::string path = fmt::format("{}/{}-{}.png", c.folder, name, what);
    if (Status s = tools::write_image(path, *picture); !s.ok()) return s;
  }
  return {};
}

// `length` is the falloff's, as a share of the scene size.
Status demo_scene(const DemoCommand& c, const std::string& name, double length, bool quiet,
                  tools::Report* report) {
  const auto executor = make_executor(c.threads);
  LoadedInput input;
  const std::string spec = fmt::format("scene:{}?size={}", name, c.size);
  if (Status s = tools::load_scene(spec, {}, *executor, &input.rendering); !s.ok()) return s;
  input.rendering.gbuffer.name = spec;
  const DepthField field = input.field();

  // The same falloff for both, whichever method is the default one.
  const auto radius = static_cast<float>(length * input.depth().scene_size);
  AnySettings fast = default_settings(kDefaultMethod);
  set_radius(radius, &fast);
  ReferenceSettings reference{.rays = kTruthRays};
  reference.falloff.radius = radius;
  tools::GeometricSettings scene{.rays = kTruthRays};
  scene.falloff.radius = radius;
  Run method, truth, world;
  Status s = run_timed(name, fast, input, c.threads, quiet, &method);
  if (s.ok()) {
    s = run_timed(name + ", truth", MethodSettings(reference), input, c.threads, quiet, &truth);
  }
  if (s.ok()) s = run_timed(name + ", scene", scene, input, c.threads, quiet, &world);
  if (s.ok()) s = write_pictures(c, name, field, method, truth, world);
  if (!s.ok()) return s;

  tools::Comparison r, w;
  const ImageView<const float> mask(&field.depth(field.guard_band.left, field.guard_band.top),
                                    field.visible().width, field.visible().height,
                                    field.depth.row_stride);
  if (s = tools::compare(method.view(), truth.view(), mask, &r); !s.ok()) return s;
  if (s = tools::compare(method.view(), world.view(), mask, &w); !s.ok()) return s;
  report->add(name, "time", 1e3 * method.seconds, "ms");
  report->add(name, "time of the truth", 1e3 * truth.seconds, "ms");
  report->add(name, "e_A", r.e_a, "%");
  report->add(name, "e_<5%", r.within_5, "%");
  report->add(name, "bias", r.bias, "%");
  report->add(name, "e_A to the scene", w.e_a, "%");
  report->add(name, "bias to the scene", w.bias, "%");
  if (!quiet) {
    fmt::print(
        "{}: {}x{}, falloff length {:.3g}: {} {:.2f} s, truth {:.2f} s, e_A {:.2f} %, "
        "e_<5% {:.1f} %, bias {:+.2f} %; to the scene itself e_A {:.2f} %, bias {:+.2f} %: "
        "{}/{}-*.png\n",
        name, field.visible().width, field.visible().height, radius, kDefaultMethod, method.seconds,
        truth.seconds, r.e_a, r.within_5, r.bias, w.e_a, w.bias, c.folder, name);
  }
  return {};
}

Status run_demo(const DemoCommand& c, bool quiet) {
  std::error_code error;
  std::filesystem::create_directories(c.folder, error);
  if (error) {
    return {StatusCode::kInternal,
            fmt::format("cannot make the folder {}: {}", c.folder, error.message())};
  }
  tools::Report report;
  report.settings = {{"method", kDefaultMethod}, {"rays", kTruthRays}, {"size", c.size}};
  if (Status s = demo_scene(c, "hall", 0.1, quiet, &report); !s.ok()) return s;
  if (Status s = demo_scene(c, "meadow", 0.05, quiet, &report); !s.ok()) return s;
  return write_json(report, c.json);
}

}  // namespace

void add_demo(App& app) {
  auto c = std::make_shared<DemoCommand>();
  CLI::App* command = app.add_command(
      "demo",
      "Render hall and meadow by the default method and by ray tracing (64 rays per pixel): "
      "pictures of both, of the error, depth and normals; a line of figures each",
      [c, &app] { return run_demo(*c, app.quiet); });
  command->add_option("-o,--output", c->folder, "Folder for the pictures [default demo]")
      ->type_name("FOLDER");
  command->add_option("--size", c->size, "Size of the pictures [default 640x360]")
      ->type_name("WIDTHxHEIGHT");
  add_threads_option(command, &c->threads);
  command->add_option("--json", c->json, "Write the figures as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace obscura::app
