#include "apps/obscura/terrain_tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/obscura/terrain_options.h"
#include "apps/obscura/work_folder.h"
#include "fmt/format.h"
#include "io/images/files.h"
#include "io/rasters/npy.h"
#include "io/report/progress_bar.h"

namespace obscura::app {
namespace {

namespace fs = std::filesystem;

// Where the radius is infinite, horizons beyond the halo come from blocks of an eighth of its
// width.
constexpr int kHalo = 512, kHaloBlocks = 8;

class TileRun {
 public:
  TileRun(const TerrainTiles& tiles, const tools::Raster& whole)
      : t_(tiles),
        whole_(whole),
        folder_(tiles.output + ".tiles"),
        halo_(tile_halo(whole, tiles.settings.radius)) {
    across_ = (whole.whole_width + t_.side - 1) / t_.side;
    count_ = across_ * ((whole.whole_height + t_.side - 1) / t_.side);
  }

  Status run() {
    const std::string about = fmt::format("{} size={}x{} tile={} halo={}", t_.about,
                                          whole_.whole_width, whole_.whole_height, t_.side, halo_);
    if (Status s = open_work_folder(folder_, t_.input, about); !s.ok()) return s;
    if (Status s = find_terrain_datum(t_.input, t_.read, whole_, &datum_); !s.ok()) return s;
    if (std::isinf(t_.settings.radius)) {
      if (Status s = find_surround(); !s.ok()) return s;
    }
    tools::ProgressBar bar("tiles", !t_.quiet);
    for (int i = t_.part - 1; i < count_; i += t_.parts) {
      if (!bar(static_cast<double>(i) / count_)) {
        return {StatusCode::kCancelled, "stopped; the same command goes on"};
      }
      if (fs::exists(tile_path(i))) continue;
      if (Status s = compute_tile(i); !s.ok()) return s;
    }
    int done = 0;
    for (int i = 0; i < count_; ++i) done += fs::exists(tile_path(i));
    if (done < count_) {
      if (!t_.quiet) fmt::print("{} of {} tiles are done\n", done, count_);
      return {};
    }
    return assemble();
  }

 private:
  std::string tile_path(int i) const { return fmt::format("{}/tile-{}.npy", folder_, i); }

  tools::RasterWindow core(int i) const {
    const int x = i % across_ * t_.side, y = i / across_ * t_.side;
    return {x, y, std::min(t_.side, whole_.whole_width - x),
            std::min(t_.side, whole_.whole_height - y)};
  }

  Status find_surround() {
    const int factor = kHalo / kHaloBlocks;
    const int width = (whole_.whole_width + factor - 1) / factor;
    const int height = (whole_.whole_height + factor - 1) / factor;
    const std::string path = folder_ + "/surround.npy";
    if (fs::exists(path)) {
      std::string bytes;
      if (Status s = tools::read_bytes(path, &bytes); !s.ok()) return s;
      return tools::decode_npy(bytes, path, &surround_);
    }
    surround_ = tools::Image(width, height);
    surround_.add("Y");
    tools::ProgressBar bar("surround", !t_.quiet);
    for (int j = 0; j < height; ++j) {
      if (!bar(static_cast<double>(j) / height)) return {StatusCode::kCancelled, "stopped"};
      const int rows = std::min(factor, whole_.whole_height - j * factor);
      tools::Raster strip;
      if (Status s = read({0, j * factor, whole_.whole_width, rows}, &strip); !s.ok()) return s;
      ElevationModel model;
      model.heights = {strip.heights.data(), strip.width, strip.height};
      float* row = surround_.channels[0].values.data() + static_cast<std::size_t>(j) * width;
      if (Status s = coarsen_terrain(model, factor, {row, width, 1}); !s.ok()) return s;
    }
    std::string bytes;
    tools::encode_npy(surround_, &bytes);
    return tools::write_text(path, bytes);
  }

  Status read(const tools::RasterWindow& window, tools::Raster* raster) const {
    tools::RasterOptions options = t_.read;
    options.window = window;
    return tools::read_raster(t_.input, options, raster);
  }

  Status compute_tile(int i) {
    const tools::RasterWindow inner = core(i);
    const int x0 = std::max(0, inner.x - halo_), y0 = std::max(0, inner.y - halo_);
    const int x1 = std::min(whole_.whole_width, inner.x + inner.width + halo_);
    const int y1 = std::min(whole_.whole_height, inner.y + inner.height + halo_);
    tools::Raster raster;
    if (Status s = read({x0, y0, x1 - x0, y1 - y0}, &raster); !s.ok()) return s;
    ElevationModel model;
    model.heights = {raster.heights.data(), raster.width, raster.height};
    model.cell_width = whole_.cell_width;
    model.cell_height = whole_.cell_height;
    model.row_widths = whole_.whole_row_widths;
    model.datum = datum_;
    model.inner = {inner.x - x0, inner.y - y0, inner.width, inner.height};
    model.surround.width = whole_.whole_width;
    model.surround.height = whole_.whole_height;
    model.surround.column = x0;
    model.surround.row = y0;
    if (!surround_.channels.empty()) {
      model.surround.heights = surround_.view(0);
      model.surround.factor = kHalo / kHaloBlocks;
    }
    TerrainQuantities results = t_.quantities;
    const TerrainOutputs outputs =
        results.allocate(inner.width, inner.height, t_.settings.azimuths);
    RunOptions run;
    run.threads = t_.threads;
    run.progress = [](double) { return !tools::interrupted(); };
    if (Status s = compute_terrain(model, t_.settings, outputs, run); !s.ok()) return s;
    // The channels one below the other.
    const int channels = static_cast<int>(results.image().channels.size());
    tools::Image stack(inner.width, inner.height * channels);
    std::vector<float>& to = stack.add("Y");
    to.clear();
    for (const auto& c : results.image().channels) {
      to.insert(to.end(), c.values.begin(), c.values.end());
    }
    std::string bytes;
    tools::encode_npy(stack, &bytes);
    return tools::write_text(tile_path(i), bytes);
  }

  Status put_tile(int i, const std::vector<std::string>& names, const tools::PutPart& put) const {
    const tools::RasterWindow inner = core(i);
    std::string bytes;
    tools::Image stack;
    if (Status s = tools::read_bytes(tile_path(i), &bytes); !s.ok()) return s;
    if (Status s = tools::decode_npy(bytes, tile_path(i), &stack); !s.ok()) return s;
    const std::size_t cells = static_cast<std::size_t>(inner.width) * inner.height;
    if (stack.channels[0].values.size() != cells * names.size()) {
      return invalid_input(tile_path(i) + " is no tile of this run; remove it");
    }
    tools::Image part(inner.width, inner.height);
    for (std::size_t c = 0; c < names.size(); ++c) {
      const float* from = stack.channels[0].values.data() + c * cells;
      part.add(names[c]).assign(from, from + cells);
    }
    return put(inner.x, inner.y, part);
  }

  Status assemble() {
    TerrainQuantities named = t_.quantities;
    (void)named.allocate(1, 1, t_.settings.azimuths);
    std::vector<std::string> names;
    for (const auto& c : named.image().channels) names.push_back(c.name);
    tools::RasterWriteOptions write;
    write.overviews = t_.overviews;
    write.settings = t_.about;
    write.units = named.units();
    const Status written = tools::write_raster_parts(
        t_.output, whole_, names, write, [&](const tools::PutPart& put) -> Status {
          for (int i = 0; i < count_; ++i) {
            if (Status s = put_tile(i, names, put); !s.ok()) return s;
          }
          return {};
        });
    std::error_code error;
    if (written.ok()) fs::remove_all(folder_, error);
    return written;
  }

  const TerrainTiles& t_;
  const tools::Raster& whole_;
  const std::string folder_;
  const int halo_;
  double datum_ = 0;
  int across_ = 0, count_ = 0;
  tools::Image surround_;
};

}  // namespace

int tile_halo(const tools::Raster& raster, double radius) {
  if (std::isinf(radius)) return kHalo;
  return static_cast<int>(std::min(radius / least_cell(raster), 1e6)) + 2;
}

// Bytes of a tile with its halo: heights as read and as swept, sums; results twice.
double tile_bytes(double side, int halo, int channels) {
  const double around = side + 2.0 * halo;
  return kProgramBytes + gdal_bytes(around) +
         4 * (around * around * (2 + channels) + 2 * side * side * channels);
}

int tile_side(double bytes, int halo, int channels) {
  int side = 0;
  while (side < 65536 && tile_bytes(side + 256, halo, channels) <= bytes) side += 256;
  return side;
}

double whole_bytes(const tools::Raster& raster, int channels) {
  return kProgramBytes + 4.0 * raster.whole_width * raster.whole_height * (2 + 2 * channels);
}

Status TerrainTiles::run() {
  tools::Raster whole;
  tools::RasterOptions corner = read;
  corner.window = tools::RasterWindow{0, 0, 1, 1};
  if (Status s = tools::read_raster(input, corner, &whole); !s.ok()) return s;
  return TileRun(*this, whole).run();
}

}  // namespace obscura::app
