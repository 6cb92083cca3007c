// obscura ao: ambient visibility of a depth image, a mesh or a scene, from file to file.
#include <cmath>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/backend.h"
#include "apps/obscura/exr_options.h"
#include "apps/obscura/input.h"
#include "apps/obscura/methods.h"
#include "apps/obscura/output.h"
#include "apps/obscura/sequence.h"
#include "fmt/format.h"
#include "io/images/files.h"

namespace obscura::app {
namespace {

struct AoCommand {
  InputOptions input;
  MethodOptions method;
  BackendOptions backend;
  SequenceOptions sequence;
  std::string output, outputs = "visibility", json;
  int threads = 0;
  ExrOptions exr;
  bool keep_channels = false;
};

double mean(const ImageView<const float>& image) {
  double sum = 0;
  std::int64_t count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (std::isnan(image(x, y))) continue;
      sum += image(x, y);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : NAN;
}

// What all frames share.
struct AoShared {
  AnySettings settings;
  MadeOnce once;
};

class AoFrame : public CommandFrame {
 public:
  AoFrame(const AoCommand& command, AoShared* shared, OutputImages images, FrameFiles files)
      : c_(command), shared_(*shared), images_(std::move(images)), files_(std::move(files)) {}

  Status read() override {
    return c_.input.load(files_.input, files_.projection, layer_needs(shared_.settings), c_.threads,
                         &input_);
  }

  Status compute(const std::function<bool(double)>& progress) override {
    const DepthField field = input_.field();
    const Outputs outputs = images_.allocate(field.visible().width, field.visible().height);
    RunOptions options{.threads = c_.threads, .progress = progress};
    if (!c_.json.empty()) options.pass_times = &pass_times_;
    if (Status s =
            c_.backend.run(shared_.settings, input_, outputs, options, &shared_.once, &ran_on_);
        !s.ok()) {
      return s;
    }
    images_.image().occluder = occluder_text(shared_.settings, field);
    has_mean_ = !outputs.visibility.empty();
    if (has_mean_) mean_ = mean(outputs.visibility);
    return {};
  }

  Status write() override {
    tools::WriteOptions write;
    write.made_by = files_.made_by;
    if (c_.keep_channels) {
      write.keep_channels_of = files_.input;
      write.kept_guard_band = input_.field().guard_band;
    }
    return c_.exr.write(files_.output, write, input_.field().guard_band, &images_.image());
  }

  std::string line() const override {
    return fmt::format("{}: {}x{}, {}{}, {:.2f} s", files_.output, images_.image().width,
                       images_.image().height, c_.method.method(),
                       has_mean_ ? fmt::format(", mean visibility {:.3f}", mean_) : "",
                       times.sum());
  }

  tools::Report report() const override {
    tools::Report report;
    report.settings = to_json(shared_.settings);
    report.settings["input"] = files_.input;
    const std::string& name = c_.method.method();
    report.settings["method"] = name;
    report.settings["ran_on"] = ran_on_;
    if (has_mean_) report.add(name, "mean visibility", mean_);
    report.add(name, "time to load", 1e3 * times.read, "ms");
    report.add(name, "time to compute", 1e3 * times.compute, "ms");
    for (const PassTime& t : pass_times_) {
      report.add(name, fmt::format("time to compute, {}", t.name), t.milliseconds, "ms");
    }
    report.add(name, "time to write", 1e3 * times.write, "ms");
    return report;
  }

 private:
  const AoCommand& c_;
  AoShared& shared_;
  OutputImages images_;
  const FrameFiles files_;
  LoadedInput input_;
  std::vector<PassTime> pass_times_;
  std::string ran_on_;
  bool has_mean_ = false;
  double mean_ = 0;
};

Status run_ao(AoCommand& c, bool quiet) {
  c.sequence.set_into(c.exr.into());
  AoShared shared;
  OutputImages images;
  if (Status s = c.method.settings(&shared.settings); !s.ok()) return s;
  if (Status s = OutputImages::parse(c.outputs, &images); !s.ok()) return s;
  if (Status s = c.exr.check(c.output); !s.ok()) return s;
  const std::string& output = c.exr.target(c.output);
  if (Status s = images.check_file(output); !s.ok()) return s;
  if (Status s = tools::check_image_ending(output); !s.ok()) return s;
  if (c.keep_channels && c.exr.into()) {
    return invalid_argument("--keep-channels belongs to --output; --into keeps all channels");
  }
  if (c.keep_channels &&
      (tools::file_ending(output) != ".exr" || tools::file_ending(c.input.path()) != ".exr")) {
    return invalid_argument("--keep-channels needs an EXR file as input and as output");
  }
  return c.sequence.run(c.input.path(), output, quiet, c.json, [&](const FrameFiles& files) {
    return std::make_unique<AoFrame>(c, &shared, images, files);
  });
}

}  // namespace

void add_ao(App& app) {
  auto c = std::make_shared<AoCommand>();
  CLI::App* command = app.add_command(
      "ao",
      "Ambient visibility of a depth image (EXR, PFM, 16-bit PNG), a mesh (OBJ, PLY, glTF, also "
      ".gz) or a procedural scene (scene:NAME?key=value&...)",
      [c, &app] { return run_ao(*c, app.quiet); });
  command
      ->add_option("-o,--output", c->output, "Result; its ending picks the format: exr, pfm, png")
      ->type_name("FILE");
  command
      ->add_option("--outputs", c->outputs,
                   fmt::format("Comma-separated results: {} [default visibility]",
                               OutputImages::all_names()))
      ->type_name("LIST");
  c->method.add_to(command, kDefaultMethod);
  c->input.add_to(command);
  c->backend.add_to(command);
  add_threads_option(command, &c->threads);
  command->add_flag("--keep-channels", c->keep_channels,
                    "Copy the input's other channels and attributes into an EXR result");
  c->exr.add_to(command);
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
  c->sequence.add_to(command, true);
}

}  // namespace obscura::app
