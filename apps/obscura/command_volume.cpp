// obscura volume: a picture of an isosurface with ambient visibility, shadow or translucency.
#include <cmath>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/option_table.h"
#include "apps/obscura/output.h"
#include "apps/obscura/volume_input.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"
#include "io/volumes/vdb.h"
#include "scene/volumes/histogram.h"
#include "scene/volumes/procedural.h"
#include "scene/volumes/volume_light.h"
#include "scene/volumes/volume_view.h"

namespace obscura::app {
namespace {

enum class VolumeMethod { kSweep, kMonteCarlo };
enum class FieldsKind { kOctants, kScalar, kDistance };

struct PictureSettings {
  VolumeMethod method = VolumeMethod::kSweep;
  FieldsKind fields_of = FieldsKind::kOctants;
  float gamma = 1;
};

// The library's settings as this command names them.
struct VolumeSettings {
  tools::VolumeViewOptions view{};
  SurfaceSettings surface{};
  DistanceSettings distance{};
  OcclusionSettings occlusion{};
  MonteCarloSettings monte_carlo{};
  PictureSettings picture{};
};

}  // namespace
}  // namespace obscura::app

namespace obscura {
template <>
struct EnumNames<app::VolumeMethod> {
  static constexpr const char* names[] = {"sweep", "monte-carlo"};
};
template <>
struct EnumNames<app::FieldsKind> {
  static constexpr const char* names[] = {"octants", "scalar", "distance"};
};

namespace app {
namespace {

template <FieldsOf<VolumeSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  auto renamed = [&](const char* from, const char* to) {
    return [&v, from, to](auto& value, Field field) {
      if (std::string_view(field.name) == from) field.name = to;
      // Opacity comes with the light.
      if (std::string_view(field.name) != "alpha") v(value, field);
    };
  };
  visit_fields(s.view, v);
  visit_fields(s.surface, v);
  v(s.picture.gamma, Field{"gamma", "", positive(), "Of a .png: visibility to the power 1/gamma."});
  visit_fields(s.distance, [&](auto& value, Field field) {
    if (std::string_view(field.name) == "isovalue") field.name = "iso";
    renamed("start", "distance_start")(value, field);
  });
  visit_fields(s.occlusion, renamed("", ""));
  v(s.picture.method, Field{"method", "", {}, "Sweeps, or rays through the same distance field."});
  visit_fields(s.monte_carlo, renamed("start", "ray_start"));
  v(s.picture.fields_of, Field{"fields_of", "", {}, "What --fields writes."});
}

struct VolumeCommand {
  std::string input, output, outputs = "visibility", light = "ao", fields, json;
  VolumeInputOptions volume;
  OptionTable table;
  int threads = 0;
  bool half = false;
};

struct Parsed {
  VolumeSettings settings;
  tools::VolumeLight light;
  bool visibility = false, coverage = false, depth = false;
};

Status parse_outputs(const VolumeCommand& c, Parsed* p) {
  const std::string list = c.outputs + ",";
  for (std::size_t at = 0, comma; (comma = list.find(',', at)) != std::string::npos;
       at = comma + 1) {
    const std::string name = list.substr(at, comma - at);
    bool* wanted = name == "visibility" ? &p->visibility
                   : name == "coverage" ? &p->coverage
                   : name == "depth"    ? &p->depth
                                        : nullptr;
    if (!wanted) {
      return invalid_argument(fmt::format(
          "--outputs names '{}'; it must be a list of visibility, coverage, depth", name));
    }
    *wanted = true;
  }
  const std::string ending = tools::file_ending(c.output);
  if (int(p->visibility) + int(p->coverage) + int(p->depth) > 1 && ending != ".exr") {
    return invalid_argument(fmt::format(
        "--output {} can hold one result; name one in --outputs, or write .exr", c.output));
  }
  if (p->depth && ending == ".png") {
    return invalid_argument(fmt::format(
        "--output {} cannot hold depth, which is not in [0, 1]; write .exr or .pfm", c.output));
  }
  return {};
}

// Everything that can be wrong before a voxel is read.
Status parse(const VolumeCommand& c, Parsed* p) {
  if (Status s = c.table.read(&p->settings); !s.ok()) return s;
  if (Status s = tools::parse_volume_light(c.light, &p->light); !s.ok()) {
    return {s.code(), "--" + s.message()};
  }
  if (c.output.empty() && c.fields.empty()) {
    return invalid_argument("nothing to write; give --output, --fields or both");
  }
  const VolumeSettings& settings = p->settings;
  if (!c.output.empty()) {
    if (Status s = tools::check_image_ending(c.output); !s.ok()) return s;
    if (Status s = parse_outputs(c, p); !s.ok()) return s;
  }
  if (c.table.given("gamma") && tools::file_ending(c.output) != ".png") {
    return invalid_argument("--gamma is for .png; other files hold linear visibility");
  }
  const bool rays = settings.picture.method == VolumeMethod::kMonteCarlo;
  for (const char* option : {"rays", "ray_start", "seed"}) {
    if (!rays && c.table.given(option)) {
      return invalid_argument(
          fmt::format("--{} belongs to --method monte-carlo", option_name(option)));
    }
  }
  if (!c.fields.empty()) {
    const std::string ending = tools::file_ending(c.fields);
    if (ending != ".nrrd" && ending != ".vdb") {
      return invalid_argument(
          fmt::format("--fields is '{}'; it must end in .nrrd or .vdb", c.fields));
    }
    if (ending == ".vdb" && !tools::has_openvdb()) {
      return unsupported("--fields: this build has no OpenVDB; write .nrrd");
    }
    const bool swept = !rays && p->light.kind != tools::VolumeLight::kHeadlight;
    if (settings.picture.fields_of != FieldsKind::kDistance &&
        (!swept || p->light.kind == tools::VolumeLight::kShadow)) {
      return invalid_argument(
          "--fields needs swept octants; leave --method and use --light ao, octants or "
          "translucent, or give --fields-of distance");
    }
  }
  return {};
}

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

Status write_fields(const VolumeCommand& c, FieldsKind kind, const tools::VolumeImage& image,
                    const std::vector<float>& distance, const VisibilityField& field,
                    const RunOptions& run) {
  tools::FieldGrid grid;
  std::vector<tools::NamedField> fields;
  const tools::Double3 h = image.spacing();
  if (kind == FieldsKind::kDistance) {
    grid = {image.size, image.axes, image.origin};
    fields.push_back({"distance", distance});
  } else {
    grid.size = field.size();
    const auto spacing = field.spacing(), origin = field.origin();
    grid.origin = image.to_world({origin[0], origin[1], origin[2]});
    for (int a = 0; a < 3; ++a) {
      for (int k = 0; k < 3; ++k) grid.axes[a][k] = image.axes[a][k] / h[a] * spacing[a];
    }
    const std::size_t voxels = std::size_t(grid.size[0]) * grid.size[1] * grid.size[2];
    const int count = kind == FieldsKind::kScalar ? 1 : 8;
    for (int s = 0; s < count; ++s) {
      fields.push_back({count == 1 ? "visibility" : fmt::format("visibility_octant_{}", s),
                        std::vector<float>(voxels)});
      const GridView<float> view(fields.back().values.data(), grid.size, spacing);
      if (Status status = count == 1 ? field.scalar(view, run) : field.octant(s, view);
          !status.ok()) {
        return status;
      }
    }
  }
  return tools::file_ending(c.fields) == ".vdb" ? tools::write_vdb(c.fields, grid, fields)
                                                : tools::write_nrrd(c.fields, grid, fields);
}

// Mean over the pixels that the surface covers, background taken out of those it covers partly.
double mean_visibility(const tools::Image& visibility, const tools::Image& coverage) {
  double sum = 0, covered = 0;
  for (std::size_t i = 0; i < coverage.channels[0].values.size(); ++i) {
    const double c = coverage.channels[0].values[i];
    sum += visibility.channels[0].values[i] - (1 - c);
    covered += c;
  }
  return covered > 0 ? sum / covered : NAN;
}

Status write_picture(const VolumeCommand& c, const Parsed& p, tools::Image visibility,
                     const tools::Image& coverage, const tools::Image& depth) {
  if (tools::file_ending(c.output) == ".png" && p.settings.picture.gamma != 1) {
    for (float& v : visibility.channels[0].values) v = std::pow(v, 1 / p.settings.picture.gamma);
  }
  tools::Image result(visibility.width, visibility.height);
  if (p.visibility) result.add("visibility") = std::move(visibility.channels[0].values);
  if (p.coverage) result.add("coverage") = coverage.channels[0].values;
  if (p.depth) result.add("depth") = depth.channels[0].values;
  tools::WriteOptions write;
  write.half = c.half;
  return tools::write_image(c.output, result, write);
}

Status run_volume(const VolumeCommand& c, bool quiet) {
  Parsed p;
  if (Status s = parse(c, &p); !s.ok()) return s;
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
  if (!status.ok()) return status;
  const double measured = watch.seconds();

  SurfaceCamera camera;
  if (Status s = tools::place_camera(image, distance, settings.view, &camera); !s.ok()) return s;
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
  report.settings["light"] = c.light;
  report.settings["clipped_size"] = image.size;
  visit_fields(settings, [&](const auto& value, const Field& field) {
    report.settings[field.name] = write_setting(value);
  });
  report.add(c.light, "time to load", 1e3 * loaded, "ms");
  report.add(c.light, "time of distances", 1e3 * (measured - loaded), "ms");
  report.add(c.light, "time of light sweeps", 1e3 * (swept - measured), "ms");
  if (!c.output.empty()) {
    const int width = settings.view.size.width, height = settings.view.size.height;
    tools::Image visibility(width, height), coverage(width, height), depth(width, height);
    for (tools::Image* i : {&visibility, &coverage, &depth}) i->add("Y");
    status = stage("render", [&](const RunOptions& run) {
      return render_surface({view, settings.distance.isovalue, settings.distance.solid, distance},
                            camera, settings.surface, shading.shader(camera),
                            {visibility.view(0), coverage.view(0), depth.view(0)}, run);
    });
    if (!status.ok()) return status;
    const double rendered = watch.seconds();
    report.add(c.light, "time to render", 1e3 * (rendered - swept), "ms");
    report.add(c.light, "mean visibility", mean_visibility(visibility, coverage));
    if (Status s = write_picture(c, p, std::move(visibility), coverage, depth); !s.ok()) return s;
    if (!quiet && c.json != "-") {
      fmt::print("{}: {}x{}, {}, mean visibility {:.3f}, {:.2f} s\n", c.output, width, height,
                 c.light, report.rows.back().value, watch.seconds());
    }
  }
  if (!c.fields.empty()) {
    status = write_fields(c, settings.picture.fields_of, image, distances, shading.field(),
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
      ->add_option("-o,--output", c->output,
                   "Picture; linear visibility with background 1 in .exr and .pfm, also .png")
      ->type_name("FILE");
  command
      ->add_option("--outputs", c->outputs,
                   "Comma-separated results: visibility, coverage, depth [default visibility]")
      ->type_name("LIST");
  command
      ->add_option("--light", c->light,
                   fmt::format("{}; directions and octants in world space; octants are numbered "
                               "from (-,-,-), x fastest [default ao]",
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

}  // namespace app
}  // namespace obscura
