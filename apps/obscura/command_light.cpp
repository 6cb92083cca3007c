// obscura light: a depth image, mesh or scene lit by an environment through its ambient visibility.
#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>

#include "apps/obscura/app.h"
#include "apps/obscura/light_frame.h"
#include "fmt/format.h"
#include "io/environments/convolution_cache.h"
#include "io/images/files.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"

namespace obscura::app {
namespace {

Status parse_three(const char* option, const std::string& text, double min, float* values) {
  std::size_t at = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',', at);
    const bool last = comma == std::string::npos;
    double value;
    if (last != (k == 2) || !parse_number(text.substr(at, last ? comma : comma - at), &value) ||
        !(value >= min && std::abs(value) <= 1e30)) {
      return invalid_argument(fmt::format("{} is '{}'; it must be three numbers{}, A,B,C", option,
                                          text, min >= 0 ? " of 0 or more" : ""));
    }
    values[k] = static_cast<float>(value);
    at = comma + 1;
  }
  return {};
}

Status one_of(const char* option, const std::string& value,
              std::initializer_list<const char*> choices) {
  std::string list;
  for (const char* choice : choices) {
    if (value == choice) return {};
    list += (list.empty() ? "" : ", ") + std::string(choice);
  }
  return invalid_argument(fmt::format("{} is '{}'; it must be one of {}", option, value, list));
}

Status with_sun_of(const LightCommand& c, PreconvolvedEnvironment* lights) {
  if (c.sun_direction.empty()) return {};
  Sun sun;
  if (Status s = parse_three("--sun-direction", c.sun_direction, -1e30, sun.direction.data());
      !s.ok()) {
    return s;
  }
  if (Status s = parse_three("--sun-irradiance", c.sun_irradiance, 0, sun.irradiance.data());
      !s.ok()) {
    return s;
  }
  sun.angular_radius = float(c.sun_radius_deg * std::numbers::pi / 180);
  PreconvolvedEnvironment result;
  if (Status s = PreconvolvedEnvironment::from_table({}, lights->table(), sun, &result); !s.ok()) {
    return s;
  }
  *lights = std::move(result);
  return {};
}

// The environment, convolved, and its sun.
Status prepare_lights(const LightCommand& c, bool quiet, LightShared* shared) {
  const tools::Stopwatch watch;
  if (Status s = tools::open_environment(c.environment, &shared->source); !s.ok()) return s;
  shared->executor = make_executor(c.threads);
  EnvironmentRepairs repairs;
  {
    tools::ProgressBar bar("environment", !quiet);
    RunOptions options;
    options.executor = shared->executor.get();
    options.progress = [&bar](double share) { return bar(share); };
    tools::ConvolutionCache cache;
    cache.enabled = !c.no_cache;
    if (Status s = tools::preconvolve(shared->source, {}, cache, &shared->lights, &repairs,
                                      &shared->from_cache, options);
        !s.ok()) {
      return s;
    }
  }
  if (!quiet && repairs.any()) {
    fmt::print(stderr, "obscura: {}: {}\n", shared->source.name, tools::describe(repairs));
  }
  if (Status s = with_sun_of(c, &shared->lights); !s.ok()) return s;
  shared->convolved = watch.seconds();
  if (c.comparator == "none" && c.no_background) return {};
  EnvironmentRepairs same;
  return tools::load_environment(shared->source, &shared->environment, &same,
                                 {.executor = shared->executor.get()});
}

Status run_light(LightCommand& c, bool quiet) {
  c.sequence.set_into(c.exr.into());
  LightShared shared;
  if (Status s = c.method.settings(&shared.method); !s.ok()) return s;
  if (Status s = c.lighting.read(&shared.lighting); !s.ok()) return s;
  if (Status s = parse_three("--albedo", c.albedo, 0, shared.albedo); !s.ok()) return s;
  if (Status s = one_of("--cones", c.cones, {"cosine", "mean"}); !s.ok()) return s;
  if (Status s = one_of("--comparator", c.comparator, {"none", "samples", "importance"}); !s.ok()) {
    return s;
  }
  if (c.backend.vulkan() && c.comparator != "none") {
    return invalid_argument(
        fmt::format("--comparator {} runs on the CPU only; leave out --backend", c.comparator));
  }
  if (Status s = c.exr.check(c.output); !s.ok()) return s;
  const std::string& output = c.exr.target(c.output);
  if (Status s = tools::check_image_ending(output); !s.ok()) return s;
  if (Status s = c.sequence.check(c.input.path(), output); !s.ok()) return s;
  if (Status s = prepare_lights(c, quiet, &shared); !s.ok()) return s;
  return c.sequence.run(c.input.path(), output, quiet, c.json, [&](const FrameFiles& files) {
    return make_light_frame(c, &shared, files);
  });
}

}  // namespace

void add_light(App& app) {
  auto c = std::make_shared<LightCommand>();
  CLI::App* command = app.add_command(
      "light", "A depth image, mesh or scene lit by an environment, through bent normals and cones",
      [c, &app] { return run_light(*c, app.quiet); });
  command
      ->add_option("--environment", c->environment,
                   "Latitude-longitude map, twice as wide as high (.hdr, .exr, .pfm), or " +
                       tools::sky_help())
      ->required()
      ->type_name("FILE|sky");
  command
      ->add_option("-o,--output", c->output,
                   "Result; linear RGB in .exr and .pfm, sRGB of [0, 1] in .png")
      ->type_name("FILE");
  c->lighting.declare("light", LightingSettings{});
  c->lighting.add_to(command, "Lighting");
  command
      ->add_option("--cones", c->cones,
                   "Bent normals and cones from the cosine-weighted integral, or from the mean "
                   "direction, as published: cosine or mean [default cosine]")
      ->type_name("NAME");
  command
      ->add_option("--comparator", c->comparator,
                   "Instead of the technique: samples (each sample carries its light: directional "
                   "occlusion with --method hemisphere, the truth with ray-traced) or importance "
                   "(directions by the light's power, with the settings of --method hemisphere): "
                   "none, samples or importance [default none]")
      ->type_name("NAME");
  command->add_option("--albedo", c->albedo, "Reflectance of all surfaces [default 1,1,1]")
      ->type_name("R,G,B");
  command->add_option("--sun-direction", c->sun_direction, "Towards a sun, world space, y up")
      ->type_name("X,Y,Z");
  command
      ->add_option("--sun-irradiance", c->sun_irradiance,
                   "Its light on a surface that faces it [default 3,3,3]")
      ->type_name("R,G,B");
  command->add_option("--sun-radius-deg", c->sun_radius_deg, "Its angular radius [default 0.27]")
      ->type_name("DEGREES");
  command
      ->add_option("--heading-deg", c->heading_deg,
                   "Rotates the camera to the right in the environment [default 0]")
      ->type_name("DEGREES");
  command
      ->add_option("--pitch-deg", c->pitch_deg,
                   "Tilts a depth image's camera upwards; a scene's is known [default 0]")
      ->type_name("DEGREES");
  command->add_option("--exposure", c->exposure, "Brightens a .png by this many stops [default 0]")
      ->type_name("STOPS");
  command->add_flag("--black-background", c->no_background,
                    "Leave pixels without geometry black instead of showing the environment");
  command->add_flag("--no-cache", c->no_cache,
                    "Neither read nor write $XDG_CACHE_HOME/obscura (~/.cache/obscura)");
  command
      ->add_option("--supersample", c->supersample,
                   "Averages N x N pixels of the lit picture into one, for smooth edges; the input "
                   "or --size must be N times as large [1 to 8, default 1]")
      ->check(CLI::Range(1, 8))
      ->type_name("N");
  c->method.add_to(command, kDefaultMethod);
  c->backend.add_to(command);
  c->input.add_to(command);
  add_threads_option(command, &c->threads);
  c->exr.add_to(command);
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
  c->sequence.add_to(command, true);
}

}  // namespace obscura::app
