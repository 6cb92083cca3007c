// obscura ao: ambient visibility of a depth image, a mesh or a scene, from file to file.
#include <cmath>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/backend.h"
#include "apps/obscura/input.h"
#include "apps/obscura/methods.h"
#include "apps/obscura/output.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"

namespace obscura::app {
namespace {

struct AoCommand {
  InputOptions input;
  MethodOptions method;
  BackendOptions backend;
  std::string output, outputs = "visibility", json;
  int threads = 0;
  bool keep_channels = false, half = false;
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

Status run_ao(const AoCommand& c, bool quiet) {
  const tools::Stopwatch watch;
  AnySettings settings;
  OutputImages images;
  if (Status s = c.method.settings(&settings); !s.ok()) return s;
  if (Status s = OutputImages::parse(c.outputs, &images); !s.ok()) return s;
  if (Status s = images.check_file(c.output); !s.ok()) return s;
  if (Status s = tools::check_image_ending(c.output); !s.ok()) return s;
  if (c.keep_channels &&
      (tools::file_ending(c.output) != ".exr" || tools::file_ending(c.input.path()) != ".exr")) {
    return invalid_argument("--keep-channels needs an EXR file as input and as output");
  }

  LoadedInput input;
  if (Status s = c.input.load(layer_needs(settings), c.threads, &input); !s.ok()) return s;
  const double loaded = watch.seconds();

  const DepthField field = input.field();
  const Outputs outputs = images.allocate(field.visible().width, field.visible().height);
  tools::ProgressBar bar(c.method.method(), !quiet);
  RunOptions options{.threads = c.threads};
  options.progress = [&bar](double share) { return bar(share); };
  std::vector<PassTime> pass_times;
  if (!c.json.empty()) options.pass_times = &pass_times;
  std::string ran_on;
  if (Status s = c.backend.run(settings, input, outputs, options, &ran_on); !s.ok()) {
    return s;
  }
  const double computed = watch.seconds();

  images.image().occluder = occluder_text(settings, field);
  tools::WriteOptions write;
  write.half = c.half;
  if (c.keep_channels) {
    write.keep_channels_of = c.input.path();
    write.kept_guard_band = field.guard_band;
  }
  if (Status s = tools::write_image(c.output, images.image(), write); !s.ok()) return s;
  const double total = watch.seconds();

  tools::Report report;
  report.settings = to_json(settings);
  report.settings["input"] = c.input.path();
  report.settings["method"] = c.method.method();
  report.settings["ran_on"] = ran_on;
  const std::string& name = c.method.method();
  if (!outputs.visibility.empty()) report.add(name, "mean visibility", mean(outputs.visibility));
  report.add(name, "time to load", 1e3 * loaded, "ms");
  report.add(name, "time to compute", 1e3 * (computed - loaded), "ms");
  for (const PassTime& t : pass_times) {
    report.add(name, fmt::format("time to compute, {}", t.name), t.milliseconds, "ms");
  }
  report.add(name, "time to write", 1e3 * (total - computed), "ms");
  if (!quiet && c.json != "-") {
    fmt::print("{}: {}x{}, {}{}, {:.2f} s\n", c.output, field.visible().width,
               field.visible().height, name,
               outputs.visibility.empty()
                   ? ""
                   : fmt::format(", mean visibility {:.3f}", mean(outputs.visibility)),
               total);
  }
  return write_json(report, c.json);
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
      ->required()
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
  command->add_flag("--half", c->half, "Write EXR channels as 16-bit floats");
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace obscura::app
