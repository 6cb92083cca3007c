// A picture of obscura light, of a sequence or alone.
#include "apps/obscura/light_frame.h"

#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "io/images/files.h"
#include "io/pictures/display.h"
#include "io/report/stopwatch.h"
#include "obscura/importance.h"
#include "scene/light/background.h"
#include "scene/light/comparators.h"

namespace obscura::app {
namespace {

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
                LightingTechnique technique, Buffers* b, const RunOptions& options, MadeOnce* once,
                std::string* ran_on) {
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
  // A Recorder keeps its normals to itself.
  if (library && !c.backend.vulkan()) outputs.normal = b->normal;
  if (Status s = c.backend.run(method, input, outputs, options, once, ran_on); !s.ok()) {
    if (s.code() != StatusCode::kUnsupported || !bent || c.cones != "cosine") return s;
    return {s.code(), fmt::format("{}; --cones mean does with bent-normal", s.message())};
  }
  if (library && c.backend.vulkan()) {
    const Status s = compute(field, HorizonSettings{}, {.normal = b->normal}, options);
    if (!s.ok()) return s;
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
                           const RunOptions& options, MadeOnce* once) {
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
  return run_method(method, input, outputs, options, once);
}

// Light by a technique from what the estimator has left in the buffers, where it ran.
Status light_by_technique(const LightCommand& c, const Buffers& buffers,
                          const PreconvolvedEnvironment& lights, const LightingSettings& settings,
                          tools::Image* image, const RunOptions& options, const MadeOnce& once,
                          const std::string& ran_on) {
  LightingInputs inputs;
  inputs.visibility = buffers.visibility;
  inputs.normal = buffers.normal;
  inputs.bent_normal = buffers.bent;
  inputs.cone_angle = buffers.angle;
  return c.backend.light(inputs, lights, settings, {image->view(0), image->view(1), image->view(2)},
                         options, once, ran_on);
}

class LightFrame : public CommandFrame {
 public:
  LightFrame(const LightCommand& command, LightShared* shared, FrameFiles files)
      : c_(command), shared_(*shared), files_(std::move(files)) {}

  Status read() override {
    return c_.input.load(files_.input, files_.projection, layer_needs(shared_.method), c_.threads,
                         &input_);
  }

  Status compute(const std::function<bool(double)>& progress) override {
    constexpr double kRadians = std::numbers::pi / 180;
    lighting_ = shared_.lighting;
    lighting_.world_from_eye = tools::world_from_eye(
        input_.rendering.scene ? input_.rendering.view.frame() : tools::Frame(),
        c_.heading_deg * kRadians, c_.pitch_deg * kRadians);
    Buffers buffers(input_.field());
    const int w = buffers.image.width, h = buffers.image.height;
    if (w % c_.supersample != 0 || h % c_.supersample != 0) {
      return invalid_argument(
          fmt::format("--supersample is {}; the visible size, {}x{}, is no multiple of it",
                      c_.supersample, w, h));
    }
    image_ = tools::Image(w, h);
    for (const char* name : {"R", "G", "B"}) image_.add(name);
    RunOptions options;
    options.executor = shared_.executor.get();
    options.progress = progress;
    const tools::Stopwatch watch;
    const bool compared = c_.comparator != "none";
    Status status = compared ? light_by_comparator(c_, shared_.method, input_, shared_.environment,
                                                   shared_.lights, lighting_.world_from_eye,
                                                   &image_, options, &shared_.once)
                             : estimate(c_, shared_.method, input_, lighting_.technique, &buffers,
                                        options, &shared_.once, &ran_on_);
    if (!status.ok()) return status;
    estimated_ = watch.seconds();
    RunOptions with_threads;
    with_threads.executor = shared_.executor.get();
    if (!compared) {
      status = light_by_technique(c_, buffers, shared_.lights, lighting_, &image_, with_threads,
                                  shared_.once, ran_on_);
    }
    if (!status.ok()) return status;
    for (int k = 0; k < 3; ++k) {
      for (float& v : image_.channels[k].values) v *= shared_.albedo[k];
    }
    lit_ = watch.seconds() - estimated_;
    return {};
  }

  Status write() override {
    tools::fill_background(input_.depth(), lighting_.world_from_eye,
                           c_.no_background ? nullptr : &shared_.environment, &image_);
    if (c_.supersample > 1) image_ = tools::box_filtered(image_, c_.supersample);
    if (tools::file_ending(files_.output) == ".png") tools::to_srgb(c_.exposure, &image_);
    tools::WriteOptions write;
    write.made_by = files_.made_by;
    const std::optional<GuardBand> guard_band =
        c_.supersample > 1 ? std::nullopt : std::optional(input_.field().guard_band);
    return c_.exr.write(files_.output, write, guard_band, &image_);
  }

  std::string line() const override {
    return fmt::format("{}: {}x{}, {}, {} of {}{}, {:.2f} s", files_.output, image_.width,
                       image_.height, name(), c_.method.method(), shared_.source.name,
                       shared_.from_cache ? " (cached)" : "", times.sum());
  }

  tools::Report report() const override {
    tools::Report report;
    report.settings = to_json(shared_.method);
    report.settings["input"] = files_.input;
    report.settings["method"] = c_.method.method();
    report.settings["backend"] = ran_on_;
    report.settings["environment"] = shared_.source.name;
    visit_fields(lighting_, [&](const auto& value, const Field& field) {
      report.settings[field.name] = write_setting(value);
    });
    report.add(name(), shared_.from_cache ? "time to read the convolution" : "time to convolve",
               1e3 * shared_.convolved, "ms");
    report.add(name(), "time to load", 1e3 * times.read, "ms");
    report.add(name(), "time to compute", 1e3 * estimated_, "ms");
    report.add(name(), "time to light", 1e3 * lit_, "ms");
    return report;
  }

 private:
  std::string name() const {
    return c_.comparator != "none" ? c_.comparator : enum_name(lighting_.technique);
  }

  const LightCommand& c_;
  LightShared& shared_;
  const FrameFiles files_;
  LoadedInput input_;
  LightingSettings lighting_;
  tools::Image image_;
  std::string ran_on_ = "cpu";
  double estimated_ = 0, lit_ = 0;  // seconds
};

}  // namespace

std::unique_ptr<CommandFrame> make_light_frame(const LightCommand& command, LightShared* shared,
                                               FrameFiles files) {
  return std::make_unique<LightFrame>(command, shared, std::move(files));
}

}  // namespace obscura::app
