// obscura terrain: sky-view factor, openness and horizons of an elevation model.
#include <cmath>
#include <memory>

#include "apps/obscura/app.h"
#include "apps/obscura/option_table.h"
#include "apps/obscura/output.h"
#include "apps/obscura/terrain_bands.h"
#include "apps/obscura/terrain_options.h"
#include "apps/obscura/terrain_quantities.h"
#include "apps/obscura/terrain_tiles.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/pictures/hill_shade.h"
#include "io/rasters/gdal.h"
#include "io/rasters/raster.h"
#include "io/report/progress_bar.h"
#include "io/report/stopwatch.h"

namespace obscura::app {

// Defaults for a field's usual work.
enum class TerrainPreset { kNone, kArchaeology, kClimate, kSolar, kCity };

// A distance in metres or in cells.
struct RadiusSpec {
  double value = std::numeric_limits<double>::infinity();
  bool cells = false;
};

// As the command names the library's settings.
struct TerrainOptions {
  TerrainPreset preset = TerrainPreset::kNone;
  TerrainSettings terrain{};
  RadiusSpec radius{};
  std::optional<double> z_factor{}, cell_size{};
  std::string nodata{};
};

}  // namespace obscura::app

namespace obscura {
template <>
struct EnumNames<app::TerrainPreset> {
  static constexpr const char* names[] = {"none", "archaeology", "climate", "solar", "city"};
};
template <>
struct SettingText<app::RadiusSpec> {
  static constexpr const char* form = "inf, metres, or cells as in 20px";
  static bool parse(std::string_view text, app::RadiusSpec* value) {
    value->cells = text.ends_with("px");
    if (value->cells) text.remove_suffix(2);
    return parse_number(text, &value->value) && value->value > 0 &&
           !(value->cells && std::isinf(value->value));
  }
  static std::string write(const app::RadiusSpec& value) {
    return write_number(value.value, false) + (value.cells ? "px" : "");
  }
};

namespace app {

template <FieldsOf<TerrainOptions> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.preset, Field{"preset", "", {}, "Defaults for a field's usual work; docs/terrain.md."});
  visit_fields(s.terrain, [&](auto& value, const Field& field) {
    const std::string_view name = field.name;
    if (name == "radius") {
      v(s.radius, field);
    } else if (name == "z_factor") {
      v(s.z_factor,
        Field{field.name, "", field.range,
              "Makes metres of heights, as 0.3048 of feet; by default the file's unit."});
    } else {
      v(value, field);
    }
  });
  v(s.cell_size,
    Field{"cell_size", "metres", {1e-4, 1e6}, "Side of a cell; by default as the file says."});
  v(s.nodata,
    Field{"nodata", "", {}, "Height of cells without data, or none; by default as the file says."});
}

namespace {

struct TerrainCommand {
  std::string input, output, quantity, picture, json, memory, part;
  OptionTable table;
  int threads = 0, band = 0, tile = 0;
  bool network = false, overviews = false;
};

struct TerrainRequest {
  TerrainOptions options;
  std::string quantity;
  TerrainQuantities quantities;
  double memory = 0;  // bytes
  int part = 1, parts = 1;
};

// The preset's settings, before those that are given; returns its quantities.
std::string apply_preset(TerrainPreset preset, TerrainOptions* o) {
  TerrainSettings& s = o->terrain;
  switch (preset) {
    case TerrainPreset::kArchaeology:
      // What the Relief Visualization Toolbox does by default: its 315 degrees count the other way.
      o->radius = {10, true};
      s.asvf_direction = 45;
      return "svf,asvf,openness,negative-openness,local-dominance";
    case TerrainPreset::kClimate:
      s.azimuths = 32;
      s.curvature = true;
      return "svf-normal,svf,visible-sky";
    case TerrainPreset::kSolar:
      s.azimuths = 72;
      s.curvature = true;
      s.refraction = 0.13;
      return "horizon,svf-normal";
    case TerrainPreset::kCity:
      s.azimuths = 64;
      return "svf,svf-cosine";
    case TerrainPreset::kNone:
      break;
  }
  return "svf";
}

Status parse_terrain(const TerrainCommand& c, TerrainRequest* p) {
  if (Status s = c.table.read(&p->options); !s.ok()) return s;
  const std::string usual = apply_preset(p->options.preset, &p->options);
  if (Status s = c.table.read(&p->options); !s.ok()) return s;
  p->quantity = c.quantity.empty() ? usual : c.quantity;
  if (Status s = validate_ranges(p->options.terrain); !s.ok()) {
    return {s.code(), "--" + s.message()};
  }
  if (Status s = parse_memory(c.memory, &p->memory); !s.ok()) return s;
  if (Status s = parse_part(c.part, &p->part, &p->parts); !s.ok()) return s;
  if (c.output.empty() && c.picture.empty()) {
    return invalid_argument("nothing to write; give --output, --picture or both");
  }
  if (Status s = TerrainQuantities::parse(p->quantity, &p->quantities); !s.ok()) return s;
  if (p->options.terrain.refraction > 0 && !p->options.terrain.curvature) {
    return invalid_argument("--refraction needs --curvature");
  }
  if (!c.output.empty()) {
    const int channels = p->quantities.channels(p->options.terrain.azimuths);
    if (Status s = tools::check_raster_ending(c.output, channels); !s.ok()) return s;
    if (tools::file_ending(c.output) == ".png" && !p->quantities.only_shares()) {
      return invalid_argument(
          fmt::format("--output {} holds shares in [0, 1]; write {} as .tif, .exr, .npy or .pfm",
                      c.output, p->quantity));
    }
  }
  if (!c.picture.empty() && tools::file_ending(c.picture) != ".png") {
    return invalid_argument(fmt::format("--picture is '{}'; it must end in .png", c.picture));
  }
  return {};
}

// What a file keeps of how it came about.
std::string settings_text(const TerrainRequest& p) {
  std::string text = "quantity=" + p.quantity;
  visit_fields(p.options, [&](const auto& value, const Field& field) {
    const std::string written = write_setting(value);
    if (!written.empty()) text += fmt::format(" {}={}", option_name(field.name), written);
  });
  return text;
}

// Parts, where they are asked for and needed; `done` says so.
Status run_in_parts(const TerrainCommand& c, const TerrainRequest& p,
                    const tools::RasterOptions& read, bool quiet, bool* done) {
  *done = false;
  const bool in_tiles = c.tile > 0 || !c.part.empty();
  if (!in_tiles && c.memory.empty()) return {};
  const std::string in = tools::file_ending(c.input), out = tools::file_ending(c.output);
  const bool image = in == ".png" || in == ".exr" || in == ".pfm" || in == ".npy";
  const bool tiff = out == ".tif" || out == ".tiff";
  if (image || !tiff || !c.picture.empty()) {
    return invalid_argument(
        "--tile, --memory and --part need a raster that GDAL reads, --output as .tif and no "
        "--picture");
  }
  tools::Raster whole;
  tools::RasterOptions corner = read;
  corner.window = tools::RasterWindow{0, 0, 1, 1};
  if (Status s = tools::read_raster(c.input, corner, &whole); !s.ok()) return s;
  return_large_arrays();
  const int azimuths = p.options.terrain.azimuths, channels = p.quantities.channels(azimuths);
  if (!in_tiles && whole_bytes(whole, channels) <= p.memory) return {};
  TerrainSettings settings = p.options.terrain;
  const double cell = std::sqrt(whole.cell_width * whole.cell_height);
  settings.radius = p.options.radius.value * (p.options.radius.cells ? cell : 1);
  settings.z_factor = whole.z_factor;
  *done = true;
  const bool long_radius = std::isfinite(settings.radius) && settings.radius >= band_radius(whole);
  if (!in_tiles && !long_radius) {
    if (std::max(whole.whole_width, whole.whole_height) > kMostTerrainCells) {
      return invalid_input(
          fmt::format("{} is {}x{} cells; --memory computes up to {} a side, --tile larger ones",
                      c.input, whole.whole_width, whole.whole_height, kMostTerrainCells));
    }
    TerrainBands bands{c.input, c.output, read, settings, p.quantities, settings_text(p)};
    bands.rows = band_rows(whole, p.memory, p.quantities, azimuths, c.threads);
    if (bands.rows == 0) {
      return too_little_memory(
          p.memory, "band of rows",
          band_bytes(whole, kLeastBandRows, p.quantities, azimuths, c.threads));
    }
    tools::limit_gdal_memory(gdal_bytes(whole.whole_width));
    bands.threads = c.threads;
    bands.overviews = c.overviews;
    bands.quiet = quiet;
    return bands.run();
  }
  TerrainTiles tiles{c.input, c.output, read, settings, p.quantities, settings_text(p)};
  const int halo = tile_halo(whole, settings.radius);
  tiles.side = c.tile > 0 ? c.tile : tile_side(p.memory, halo, channels);
  if (tiles.side == 0) {
    return too_little_memory(p.memory, "tile with its halo", tile_bytes(256, halo, channels));
  }
  if (!c.memory.empty()) tools::limit_gdal_memory(gdal_bytes(tiles.side + 2.0 * halo));
  tiles.part = p.part;
  tiles.parts = p.parts;
  tiles.threads = c.threads;
  tiles.overviews = c.overviews;
  tiles.quiet = quiet;
  return tiles.run();
}

Status run_terrain(const TerrainCommand& c, bool quiet) {
  TerrainRequest p;
  if (Status s = parse_terrain(c, &p); !s.ok()) return s;
  TerrainSettings& settings = p.options.terrain;
  const tools::Stopwatch watch;
  tools::Raster raster;
  tools::RasterOptions read;
  read.band = c.band;
  read.nodata = p.options.nodata;
  read.cell_size = p.options.cell_size;
  read.z_factor = p.options.z_factor;
  read.network = c.network;
  bool done = false;
  if (Status s = run_in_parts(c, p, read, quiet, &done); !s.ok() || done) return s;
  if (Status s = tools::read_raster(c.input, read, &raster); !s.ok()) return s;
  const double loaded = watch.seconds();

  const double cell = std::sqrt(raster.cell_width * raster.cell_height);
  settings.radius = p.options.radius.value * (p.options.radius.cells ? cell : 1);
  settings.z_factor = raster.z_factor;
  ElevationModel model;
  model.heights = {raster.heights.data(), raster.width, raster.height};
  model.cell_width = raster.cell_width;
  model.cell_height = raster.cell_height;
  model.row_widths = raster.row_widths;
  TerrainQuantities wanted = p.quantities;
  if (!c.picture.empty()) wanted.include("svf-normal");
  const TerrainOutputs outputs = wanted.allocate(raster.width, raster.height, settings.azimuths);
  {
    tools::ProgressBar bar("terrain", !quiet);
    RunOptions run;
    run.threads = c.threads;
    run.progress = [&bar](double share) { return bar(share); };
    if (Status s = compute_terrain(model, settings, outputs, run); !s.ok()) return s;
  }
  const double computed = watch.seconds();
  if (!c.picture.empty()) {
    const tools::Image picture = tools::hill_shade(wanted.view("svf-normal"));
    if (Status s = tools::write_image(c.picture, picture); !s.ok()) return s;
  }
  if (!c.output.empty()) {
    const int channels = p.quantities.channels(settings.azimuths);
    wanted.image().channels.resize(channels);
    tools::RasterWriteOptions write;
    write.overviews = c.overviews;
    write.settings = settings_text(p);
    write.units = wanted.units();
    if (Status s = tools::write_raster(c.output, raster, wanted.image(), write); !s.ok()) return s;
  }
  const double cells = static_cast<double>(raster.width) * raster.height;
  if (!quiet && c.json != "-") {
    fmt::print(
        "{}: {}x{} cells of {:.6g} x {:.6g} m, {} azimuths, {:.2f} s, {:.2f} million cells "
        "a second\n",
        c.output.empty() ? c.picture : c.output, raster.width, raster.height, raster.cell_width,
        raster.cell_height, settings.azimuths, computed - loaded,
        1e-6 * cells / (computed - loaded));
  }
  tools::Report report;
  report.settings["input"] = c.input;
  report.settings["quantity"] = p.quantity;
  visit_fields(p.options, [&](const auto& value, const Field& field) {
    report.settings[field.name] = write_setting(value);
  });
  report.add(p.quantity, "time to load", 1e3 * loaded, "ms");
  report.add(p.quantity, "time to compute", 1e3 * (computed - loaded), "ms");
  return write_json(report, c.json);
}

}  // namespace

void add_terrain(App& app) {
  auto c = std::make_shared<TerrainCommand>();
  CLI::App* command =
      app.add_command("terrain", "Sky-view factor, openness and horizons of an elevation model",
                      [c, &app] { return run_terrain(*c, app.quiet); });
  command
      ->add_option("INPUT", c->input,
                   "Heights: GeoTIFF, ASCII grid, VRT and whatever GDAL reads; .png, .exr, .pfm, "
                   ".npy")
      ->required()
      ->type_name("");
  command
      ->add_option("-o,--output", c->output,
                   "Results by the ending: .tif, .exr and .npy several; .pfm and .png one")
      ->type_name("FILE");
  command
      ->add_option("--quantity", c->quantity,
                   "Comma-separated results: " + TerrainQuantities::all_names() +
                       " [default svf, or the preset's]")
      ->type_name("LIST");
  command
      ->add_option("--picture", c->picture,
                   "A hill shade by ambient light, for looking at, as .png")
      ->type_name("FILE");
  c->table.declare("terrain", TerrainOptions{});
  c->table.add_to(command, "Settings");
  command->add_option("--band", c->band, "Band that holds heights, from 1; needed for several")
      ->check(CLI::Range(1, 65535))
      ->type_name("N");
  command->add_option("--tile", c->tile, "Compute in tiles of so many cells a side, with a halo")
      ->check(CLI::Range(64, 65536))
      ->type_name("N");
  command
      ->add_option("--memory", c->memory,
                   "Compute in bands of rows, exactly, where the whole takes more than this, as 2G")
      ->type_name("SIZE");
  command
      ->add_option("--part", c->part,
                   "Compute only every Nth tile, from the Ith; the run that finds all tiles done "
                   "writes the output")
      ->type_name("I/N");
  command->add_flag("--network", c->network, "Read files that lie in a network, too");
  command->add_flag("--overviews", c->overviews, "Reduced copies in a .tif, for fast display");
  add_threads_option(command, &c->threads);
  command->add_option("--json", c->json, "Write times and settings as JSON; - is standard output")
      ->type_name("FILE");
}

}  // namespace app
}  // namespace obscura
