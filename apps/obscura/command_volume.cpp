// obscura volume: a picture of an isosurface with ambient visibility, shadow or translucency.
#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/output.h"
#include "apps/obscura/volume_command.h"
#include "fmt/format.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"
#include "scene/volumes/histogram.h"
#include "scene/volumes/procedural.h"

namespace obscura::app {
namespace {

// The isovalue and side: as given, else the volume's own, else Otsu's threshold.
Status choose_isovalue(const VolumeCommand& c, const tools::VolumeImage& image, bool quiet,
                       DistanceSettings* distance) {
  if (!c.table.given("solid") && image.solid) distance->solid = *image.solid;
  if (c.table.given("iso")) return {};
  const char* why = "the volume's own";
  if (image.isovalue) {
    distance->isovalue = *image.isovalue;
  } else {
    tools::Histogram histogram;
    double threshold = 0;
    if (Status s = tools::make_histogram(image, &histogram); !s.ok()) return s;
    if (Status s = tools::otsu_threshold(image, histogram, &threshold); !s.ok()) return s;
    distance->isovalue = float(threshold);
    why = "Otsu's threshold; choose another by --iso";
  }
  if (!quiet && c.json != "-") fmt::print("isovalue {:g} ({})\n", distance->isovalue, why);
  return {};
}

// A refused isovalue, named as the user gave it.
Status named_by_option(const Status& s, const VolumeCommand& c) {
  const bool isovalue = s.message().starts_with("isovalue") && c.table.given("iso");
  return isovalue ? Status(s.code(), "--iso: " + s.message()) : s;
}

// What is said where no ray meets the surface: of a camera that was placed, where the volume lies.
Status misses_the_surface(const VolumeCommand& c, const tools::VolumeImage& image) {
  if (!c.table.given("eye") && !c.table.given("look_at")) {
    return invalid_input(
        fmt::format("{}: its surface is smaller than a pixel; its matter is few voxels among NaN. "
                    "Choose another --iso, or clip the NaN away by --clip",
                    image.name));
  }
  tools::Double3 low, high;
  low.fill(INFINITY);
  high.fill(-INFINITY);
  const tools::Double3 h = image.spacing();
  for (int corner = 0; corner < 8; ++corner) {
    tools::Double3 p;
    for (int a = 0; a < 3; ++a) p[a] = corner >> a & 1 ? (image.size[a] - 1) * h[a] : 0;
    const tools::Double3 world = image.to_world(p);
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], world[a]);
      high[a] = std::max(high[a], world[a]);
    }
  }
  return invalid_argument(fmt::format(
      "the picture misses the surface; --eye and --look-at must show a part of the volume, which "
      "reaches from {:g},{:g},{:g} to {:g},{:g},{:g}",
      low[0], low[1], low[2], high[0], high[1], high[2]));
}

Status run_volume(const VolumeCommand& c, bool quiet) {
  VolumeRequest p;
  if (Status s = read_request(c, &p); !s.ok()) return s;
  VolumeSettings& settings = p.settings;
  const tools::Stopwatch watch;
  tools::VolumeImage image;
  if (Status s = c.volume.load(c.input, c.threads, &image); !s.ok()) return s;
  if (Status s = choose_isovalue(c, image, quiet, &settings.distance); !s.ok()) return s;
  const double loaded = watch.seconds();

  const auto executor = make_executor(c.threads);
  // Runs one stage under a progress bar of its own.
  auto stage = [&](const char* name, auto&& work) {
    tools::ProgressBar bar(name, !quiet);
    RunOptions run;
    run.executor = executor.get();
    run.progress = [&bar](double share) { return bar(share); };
    return work(run);
  };
  std::vector<float> distances(std::size_t(image.voxels()));
  const VolumeView view = image.view();
  const GridView<float> distance(distances.data(), image.size, view.spacing);
  Status status = stage("distance", [&](const RunOptions& run) {
    return sweep_distance(view, settings.distance, distance, run);
  });
  if (!status.ok()) return named_by_option(status, c);
  const double measured = watch.seconds();

  SurfaceCamera camera;
  if (Status s = tools::place_camera(image, distance, settings.view, &camera,
                                     {.executor = executor.get()});
      !s.ok()) {
    return s;
  }
  tools::VolumeShading shading;
  tools::VolumeTruth truth;
  truth.monte_carlo = settings.picture.method == VolumeMethod::kMonteCarlo;
  truth.settings = settings.monte_carlo;
  status = stage("light", [&](const RunOptions& run) {
    return shading.prepare(image, distance, p.light, settings.occlusion, truth, run);
  });
  if (!status.ok()) return status;
  const double swept = watch.seconds();

  tools::Report report;
  report.settings["input"] = c.input;
  report.settings["light"] = p.light_name;
  report.settings["clipped_size"] = image.size;
  visit_fields(settings, [&](const auto& value, const Field& field) {
    report.settings[field.name] = write_setting(value);
  });
  report.add(p.light_name, "time to load", 1e3 * loaded, "ms");
  report.add(p.light_name, "time of distances", 1e3 * (measured - loaded), "ms");
  report.add(p.light_name, "time of light sweeps", 1e3 * (swept - measured), "ms");
  if (!c.output.empty()) {
    const int width = settings.view.size.width, height = settings.view.size.height;
    VolumePictures pictures;
    for (tools::Image* i : {&pictures.visibility, &pictures.coverage, &pictures.depth}) {
      *i = tools::Image(width, height);
      i->add("Y");
    }
    status = stage("render", [&](const RunOptions& run) {
      return render_surface(
          {view, settings.distance.isovalue, settings.distance.solid, distance}, camera,
          settings.surface, shading.shader(camera),
          {pictures.visibility.view(0), pictures.coverage.view(0), pictures.depth.view(0)}, run);
    });
    if (!status.ok()) return status;
    const double rendered = watch.seconds(), mean = mean_visibility(pictures);
    if (std::isnan(mean)) return misses_the_surface(c, image);
    const char* measured_light = p.picture ? "mean light" : "mean visibility";
    report.add(p.light_name, "time to render", 1e3 * (rendered - swept), "ms");
    report.add(p.light_name, measured_light, mean);
    if (Status s = write_volume_picture(c, p, std::move(pictures)); !s.ok()) return s;
    if (!quiet && c.json != "-") {
      fmt::print("{}: {}x{}, {}, {} {:.3f}, {:.2f} s\n", c.output, width, height, p.light_name,
                 measured_light, mean, watch.seconds());
    }
  }
  if (!c.fields.empty()) {
    status = write_volume_fields(c, settings.picture.fields_of, image, distances, shading.field(),
                                 {.executor = executor.get()});
    if (!status.ok()) return status;
    if (!quiet && c.json != "-") {
      fmt::print("{}: {}\n", c.fields, enum_name(settings.picture.fields_of));
    }
  }
  return write_json(report, c.json);
}

}  // namespace

void add_volume(App& app) {
  auto c = std::make_shared<VolumeCommand>();
  CLI::App* command = app.add_command(
      "volume",
      "A volume's isosurface with ambient visibility, shadow or translucency, and its fields",
      [c, &app] { return run_volume(*c, app.quiet); });
  command
      ->add_option("INPUT", c->input,
                   "NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr), OpenVDB (.vdb), .raw, or " +
                       tools::procedural_volume_names() + " with ?size=N&seed=N")
      ->required()
      ->type_name("");
  command
      ->add_option(
          "-o,--output", c->output,
          "Picture: .png lit and in colours; linear visibility with background 1 in .exr and .pfm")
      ->type_name("FILE");
  command
      ->add_option(
          "--outputs", c->outputs,
          "Comma-separated results in place of a picture: visibility, coverage, depth [default "
          "visibility]")
      ->type_name("LIST");
  command
      ->add_option("--light", c->light,
                   fmt::format("{}; directions and octants in world space; octants are numbered "
                               "from (-,-,-), x fastest; lit is a sky, a lamp at the camera and "
                               "ambient visibility together [default lit in .png, else ao]",
                               tools::VolumeLight::kForm))
      ->type_name("LIGHT");
  c->table.declare("volume", VolumeSettings{});
  c->table.add_to(command, "Settings");
  c->volume.add_to(command);
  command
      ->add_option("--fields", c->fields,
                   "Write fields as floats, by the ending: .nrrd or .vdb; octants of the grid")
      ->type_name("FILE");
  add_threads_option(command, &c->threads);
  command->add_flag("--half", c->half, "Write EXR channels as 16-bit floats");
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace obscura::app
