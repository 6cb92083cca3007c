// obscura light: a depth image, mesh or scene lit by an environment through its ambient visibility.
#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>

#include "apps/obscura/app.h"
#include "apps/obscura/input.h"
#include "apps/obscura/methods.h"
#include "apps/obscura/output.h"
#include "fmt/format.h"
#include "io/environments/convolution_cache.h"
#include "io/images/files.h"
#include "io/pictures/display.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"
#include "obscura/importance.h"
#include "obscura/lighting.h"
#include "scene/light/background.h"
#include "scene/light/comparators.h"

namespace obscura::app {
namespace {

struct LightCommand {
  InputOptions input;
  MethodOptions method;
  OptionTable lighting;
  std::string environment, output, json;
  std::string albedo = "1,1,1", sun_direction, sun_irradiance = "3,3,3";
  double sun_radius_deg = 0.27, heading_deg = 0, pitch_deg = 0, exposure = 0;
  std::string cones = "cosine", comparator = "none";
  bool no_background = false, no_cache = false, half = false;
  int threads = 0, supersample = 1;
};

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

// What the lighting reads, at the visible size.
struct Buffers {
  explicit Buffers(const DepthField& f) : image(f.visible().width, f.visible().height) {
    for (const char* name : {"visibility", "angle", "nx", "ny", "nz", "bx", "by", "bz"}) {
      image.add(name);
    }
    visibility = image.view(0), angle = image.view(1);
    normal = {image.view(2), image.view(3), image.view(4)};
    bent = {image.view(5), image.view(6), image.view(7)};
  }
  tools::Image image;
  ImageView<float> visibility, angle;
  VectorView<float> normal, bent;
};

Status estimate(const LightCommand& c, const AnySettings& method, const LoadedInput& input,
                LightingTechnique technique, Buffers* b, const RunOptions& options) {
  const tools::DepthInput& g = input.depth();
  const DepthField field = input.field();
  Outputs outputs;
  outputs.visibility = b->visibility;
  const bool bent = technique != LightingTechnique::kAmbientOcclusion;
  if (bent && c.cones == "cosine") {
    outputs.cosine_integral = b->bent;
  } else if (bent) {
    outputs.bent_normal = b->bent;
    if (technique == LightingTechnique::kBentCone) outputs.cone_angle = b->angle;
  }
  const bool library = std::holds_alternative<MethodSettings>(method);
  if (library) outputs.normal = b->normal;
  if (Status s = run_method(method, input, outputs, options); !s.ok()) {
    if (s.code() != StatusCode::kUnsupported || !bent || c.cones != "cosine") return s;
    return {s.code(), fmt::format("{}; --cones mean does with bent-normal", s.message())};
  }
  if (!library) {
    for (int y = 0; y < field.visible().height; ++y) {
      for (int x = 0; x < field.visible().width; ++x) {
        const std::size_t i = std::size_t(y + g.guard_band.top) * g.width + x + g.guard_band.left;
        b->normal.x(x, y) = g.normal_x[i];
        b->normal.y(x, y) = g.normal_y[i];
        b->normal.z(x, y) = g.normal_z[i];
      }
    }
  }
  if (bent && c.cones == "cosine") {
    return cones_from_cosine_integral(b->visibility, b->bent, b->bent, b->angle, options);
  }
  return {};
}

// Light by what cones are compared with; the sun is the convolved light's.
Status light_by_comparator(const LightCommand& c, AnySettings method, const LoadedInput& input,
                           const Environment& map, const PreconvolvedEnvironment& lights,
                           const std::array<float, 9>& m, tools::Image* image,
                           const RunOptions& options) {
  Environment environment;
  if (Status s = map.with_sun(lights.sun(), &environment); !s.ok()) return s;
  const VectorView<float> out{image->view(0), image->view(1), image->view(2)};
  auto* library = std::get_if<MethodSettings>(&method);
  auto* hemisphere = library ? std::get_if<HemisphereSettings>(library) : nullptr;
  auto* reference = library ? std::get_if<ReferenceSettings>(library) : nullptr;
  if (c.comparator == "importance" && hemisphere) {
    ImportanceSettings settings{.falloff = hemisphere->falloff,
                                .occluder = hemisphere->occluder,
                                .samples = hemisphere->samples,
                                .steps = std::max(hemisphere->steps, 1),
                                .interleave = hemisphere->interleave,
                                .blur = hemisphere->blur,
                                .seed = hemisphere->seed,
                                .world_from_eye = m};
    return light_by_importance(input.field(), environment, settings, out, options);
  }
  if (c.comparator == "samples" && hemisphere) {
    hemisphere->radiance = tools::light_of_samples(lights, hemisphere->samples, m);
  } else if (c.comparator == "samples" && reference) {
    reference->radiance = tools::light_of_rays(environment, m);
  } else {
    return invalid_argument(
        fmt::format("--comparator {} needs --method hemisphere{}, not {}", c.comparator,
                    c.comparator == "samples" ? " or ray-traced" : "", c.method.method()));
  }
  Outputs outputs;
  outputs.radiance = out;
  return run_method(method, input, outputs, options);
}

// Light by a technique from what the estimator has left in the buffers.
Status light_by_technique(const Buffers& buffers, const PreconvolvedEnvironment& lights,
                          const LightingSettings& settings, tools::Image* image,
                          const RunOptions& options) {
  LightingInputs inputs;
  inputs.visibility = buffers.visibility;
  inputs.normal = buffers.normal;
  inputs.bent_normal = buffers.bent;
  inputs.cone_angle = buffers.angle;
  return light(inputs, lights, settings, {image->view(0), image->view(1), image->view(2)}, options);
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

Status run_light(const LightCommand& c, bool quiet) {
  const tools::Stopwatch watch;
  AnySettings method;
  LightingSettings settings;
  float albedo[3];
  if (Status s = c.method.settings(&method); !s.ok()) return s;
  if (Status s = c.lighting.read(&settings); !s.ok()) return s;
  if (Status s = parse_three("--albedo", c.albedo, 0, albedo); !s.ok()) return s;
  if (Status s = one_of("--cones", c.cones, {"cosine", "mean"}); !s.ok()) return s;
  if (Status s = one_of("--comparator", c.comparator, {"none", "samples", "importance"}); !s.ok()) {
    return s;
  }
  if (Status s = tools::check_image_ending(c.output); !s.ok()) return s;
  tools::EnvironmentSource source;
  if (Status s = tools::open_environment(c.environment, &source); !s.ok()) return s;

  const auto executor = make_executor(c.threads);
  PreconvolvedEnvironment lights;
  EnvironmentRepairs repairs;
  bool from_cache = false;
  {
    tools::ProgressBar bar("environment", !quiet);
    RunOptions options;
    options.executor = executor.get();
    options.progress = [&bar](double share) { return bar(share); };
    tools::ConvolutionCache cache;
    cache.enabled = !c.no_cache;
    if (Status s = tools::preconvolve(source, {}, cache, &lights, &repairs, &from_cache, options);
        !s.ok()) {
      return s;
    }
  }
  if (!quiet && repairs.any()) {
    fmt::print(stderr, "obscura: {}: {}\n", source.name, tools::describe(repairs));
  }
  if (Status s = with_sun_of(c, &lights); !s.ok()) return s;
  const double convolved = watch.seconds();

  LoadedInput input;
  if (Status s = c.input.load(layer_needs(method), c.threads, &input); !s.ok()) return s;
  const double loaded = watch.seconds();
  constexpr double kRadians = std::numbers::pi / 180;
  settings.world_from_eye =
      tools::world_from_eye(input.rendering.scene ? input.rendering.view.frame() : tools::Frame(),
                            c.heading_deg * kRadians, c.pitch_deg * kRadians);
  Environment environment;
  const bool compared = c.comparator != "none";
  if (compared || !c.no_background) {
    EnvironmentRepairs same;
    if (Status s =
            tools::load_environment(source, &environment, &same, {.executor = executor.get()});
        !s.ok()) {
      return s;
    }
  }

  Buffers buffers(input.field());
  const int w = buffers.image.width, h = buffers.image.height;
  if (w % c.supersample != 0 || h % c.supersample != 0) {
    return invalid_argument(fmt::format(
        "--supersample is {}; the visible size, {}x{}, is no multiple of it", c.supersample, w, h));
  }
  tools::Image image(w, h);
  for (const char* name : {"R", "G", "B"}) image.add(name);
  tools::ProgressBar bar(c.method.method(), !quiet);
  RunOptions options;
  options.executor = executor.get();
  options.progress = [&bar](double share) { return bar(share); };
  const double prepared = watch.seconds();
  Status status = compared ? light_by_comparator(c, method, input, environment, lights,
                                                 settings.world_from_eye, &image, options)
                           : estimate(c, method, input, settings.technique, &buffers, options);
  if (!status.ok()) return status;
  const double estimated = watch.seconds();
  RunOptions with_threads;
  with_threads.executor = executor.get();
  if (!compared) status = light_by_technique(buffers, lights, settings, &image, with_threads);
  if (!status.ok()) return status;
  for (int k = 0; k < 3; ++k) {
    for (float& v : image.channels[k].values) v *= albedo[k];
  }
  const double lit = watch.seconds();

  tools::fill_background(input.depth(), settings.world_from_eye,
                         c.no_background ? nullptr : &environment, &image);
  if (c.supersample > 1) image = tools::box_filtered(image, c.supersample);
  if (tools::file_ending(c.output) == ".png") tools::to_srgb(c.exposure, &image);
  tools::WriteOptions write;
  write.half = c.half;
  if (Status s = tools::write_image(c.output, image, write); !s.ok()) return s;

  tools::Report report;
  report.settings = to_json(method);
  report.settings["input"] = c.input.path();
  report.settings["method"] = c.method.method();
  report.settings["environment"] = source.name;
  visit_fields(settings, [&](const auto& value, const Field& field) {
    report.settings[field.name] = write_setting(value);
  });
  const std::string name = compared ? c.comparator : enum_name(settings.technique);
  report.add(name, from_cache ? "time to read the convolution" : "time to convolve",
             1e3 * convolved, "ms");
  report.add(name, "time to load", 1e3 * (loaded - convolved), "ms");
  report.add(name, "time to compute", 1e3 * (estimated - prepared), "ms");
  report.add(name, "time to light", 1e3 * (lit - estimated), "ms");
  if (!quiet && c.json != "-") {
    fmt::print("{}: {}x{}, {}, {} of {}{}, {:.2f} s\n", c.output, image.width, image.height, name,
               c.method.method(), source.name, from_cache ? " (cached)" : "", watch.seconds());
  }
  return write_json(report, c.json);
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
      ->required()
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
  c->input.add_to(command);
  add_threads_option(command, &c->threads);
  command->add_flag("--half", c->half, "Write EXR channels as 16-bit floats");
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace obscura::app
