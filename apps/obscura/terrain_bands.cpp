#include "apps/obscura/terrain_bands.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <thread>

#include "apps/obscura/terrain_options.h"
#include "apps/obscura/work_folder.h"
#include "fmt/format.h"
#include "io/images/atomic_file.h"
#include "io/images/files.h"
#include "io/rasters/gdal.h"
#include "io/rasters/hull_file.h"
#include "io/report/progress_bar.h"

namespace obscura::app {
namespace {

namespace fs = std::filesystem;

class BandRun {
 public:
  BandRun(const TerrainBands& bands, const tools::Raster& whole)
      : b_(bands),
        whole_(whole),
        folder_(bands.output + ".bands"),
        count_((whole.whole_height + bands.rows - 1) / bands.rows) {}

  Status run() {
    const std::string about = fmt::format("{} size={}x{} rows={}", b_.about, whole_.whole_width,
                                          whole_.whole_height, b_.rows);
    if (Status s = open_work_folder(folder_, b_.input, about); !s.ok()) return s;
    if (Status s = find_terrain_datum(b_.input, b_.read, whole_, &datum_); !s.ok()) return s;
    tools::ProgressBar bar("bands", !b_.quiet);
    int done = 0;
    for (const bool up : {false, true}) {
      for (int i = 0; i < count_; ++i) {
        if (!bar(0.5 * done++ / count_)) {
          return {StatusCode::kCancelled, "stopped; the same command goes on"};
        }
        const int band = up ? count_ - 1 - i : i;
        if (fs::exists(results(true, band)) || (!up && fs::exists(results(false, band)))) continue;
        if (Status s = compute(band, up, i); !s.ok()) return s;
      }
    }
    return assemble();
  }

 private:
  static const char* name(bool up) { return up ? "up" : "down"; }
  std::string results(bool up, int band) const {
    return fmt::format("{}/{}-{}.f32", folder_, name(up), band);
  }
  std::string hulls(bool up, int band) const {
    return fmt::format("{}/{}-{}.hulls", folder_, name(up), band);
  }
  int first_row(int band) const { return band * b_.rows; }
  int rows(int band) const { return std::min(b_.rows, whole_.whole_height - first_row(band)); }

  Status read(int row, int count, tools::Raster* raster) const {
    tools::RasterOptions options = b_.read;
    options.window = tools::RasterWindow{0, row, whole_.whole_width, count};
    return tools::read_raster(b_.input, options, raster);
  }

  // `order`: of the band among those in this direction.
  Status compute(int band, bool up, int order) {
    const int above = std::min(first_row(band), kTerrainBandHalo);
    const int end = first_row(band) + rows(band);
    const int below = std::min(whole_.whole_height - end, kTerrainBandHalo);
    tools::Raster raster;
    if (Status s = read(first_row(band) - above, above + rows(band) + below, &raster); !s.ok()) {
      return s;
    }
    ElevationModel model;
    model.heights = {raster.heights.data(), raster.width, raster.height};
    model.cell_width = whole_.cell_width;
    model.cell_height = whole_.cell_height;
    model.row_widths = whole_.whole_row_widths;
    model.inner = {0, above, raster.width, rows(band)};
    model.datum = datum_;
    const int step = up ? -1 : 1, width = whole_.whole_width;
    tools::HullFile from(hulls(up, band - step), width), to(hulls(up, band), width);
    TerrainBand place;
    place.height = whole_.whole_height;
    place.row = first_row(band) - above;
    place.up = up;
    if (order > 0) {
      if (Status s = from.load(); !s.ok()) return s;
      place.from = &from;
    }
    if (order + 1 < count_) {
      if (Status s = to.create(); !s.ok()) return s;
      place.to = &to;
    }
    TerrainQuantities quantities = b_.quantities;
    const TerrainOutputs outputs =
        quantities.allocate(raster.width, rows(band), b_.settings.azimuths);
    if (up) {
      if (Status s = load(results(false, band), &quantities.image()); !s.ok()) return s;
    }
    RunOptions run;
    run.threads = b_.threads;
    run.progress = [](double) { return !tools::interrupted(); };
    if (Status s = compute_terrain_band(model, place, b_.settings, outputs, run); !s.ok()) return s;
    if (place.to) {
      if (Status s = to.finish(); !s.ok()) return s;
    }
    if (Status s = save(results(up, band), quantities.image()); !s.ok()) return s;
    // Only now is there a later band to go on from.
    std::error_code error;
    if (order > 0) fs::remove(hulls(up, band - step), error);
    if (up) fs::remove(results(false, band), error);
    return {};
  }

  // Channels of a band, one behind the other. It need not outlive a loss of power, so nobody waits
  // for the disk.
  static Status save(const std::string& path, const tools::Image& image) {
    const tools::IgnoreFileSizeSignal guard;
    const std::string part = path + ".part";
    std::FILE* file = std::fopen(part.c_str(), "wb");
    bool written = file != nullptr;
    for (const auto& c : image.channels) {
      written = written && std::fwrite(c.values.data(), sizeof(float), c.values.size(), file) ==
                               c.values.size();
    }
    const int error = errno;
    const bool closed = file && std::fclose(file) == 0;
    if (written && closed && std::rename(part.c_str(), path.c_str()) == 0) return {};
    const char* reason = std::strerror(written ? errno : error);
    return {StatusCode::kInternal, fmt::format("cannot write {}: {}", path, reason)};
  }
  static Status load(const std::string& path, tools::Image* image) {
    std::FILE* file = std::fopen(path.c_str(), "rb");
    bool whole = file != nullptr;
    for (auto& c : image->channels) {
      whole = whole &&
              std::fread(c.values.data(), sizeof(float), c.values.size(), file) == c.values.size();
    }
    whole = whole && std::fgetc(file) == EOF;
    if (file) std::fclose(file);
    if (whole) return {};
    return invalid_input(path + " is no band of this run; remove it with its folder");
  }

  Status assemble() {
    TerrainQuantities named = b_.quantities;
    (void)named.allocate(1, 1, b_.settings.azimuths);
    std::vector<std::string> names;
    for (const auto& c : named.image().channels) names.push_back(c.name);
    tools::RasterWriteOptions write;
    write.overviews = b_.overviews;
    write.settings = b_.about;
    write.units = named.units();
    const Status written = tools::write_raster_parts(
        b_.output, whole_, names, write, [&](const tools::PutPart& put) -> Status {
          for (int band = 0; band < count_; ++band) {
            tools::Image part(whole_.whole_width, rows(band));
            for (const std::string& n : names) part.add(n);
            if (Status s = load(results(true, band), &part); !s.ok()) return s;
            if (Status s = put(0, first_row(band), part); !s.ok()) return s;
          }
          return {};
        });
    std::error_code error;
    if (written.ok()) fs::remove_all(folder_, error);
    return written;
  }

  const TerrainBands& b_;
  const tools::Raster& whole_;
  const std::string folder_;
  const int count_;
  double datum_ = 0;
};

}  // namespace

double band_radius(const tools::Raster& raster) { return kTerrainBandRadius * least_cell(raster); }

double band_bytes(const tools::Raster& raster, int rows, const TerrainQuantities& quantities,
                  int azimuths, int threads) {
  const double width = raster.whole_width, height = raster.whole_height;
  const double halo = 2 * kTerrainBandHalo, cells = (rows + halo) * (width + halo);
  // Heights as read and as swept, sums, results; the chains of each thread.
  const double planes = 2 + quantities.sums() + quantities.channels(azimuths);
  if (threads == 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const double chains = threads * 1024 * (std::max(width, height) + rows);
  return kProgramBytes + gdal_bytes(raster.whole_width) + 4 * cells * planes + chains;
}

int band_rows(const tools::Raster& raster, double bytes, const TerrainQuantities& quantities,
              int azimuths, int threads) {
  const auto fits = [&](int rows) {
    return band_bytes(raster, rows, quantities, azimuths, threads) <= bytes;
  };
  int rows = 0;
  for (int step = 1 << 18; step >= kLeastBandRows; step /= 2) {
    if (fits(rows + step)) rows += step;
  }
  return std::min(rows, raster.whole_height);
}

Status TerrainBands::run() {
  tools::Raster whole;
  tools::RasterOptions corner = read;
  corner.window = tools::RasterWindow{0, 0, 1, 1};
  if (Status s = tools::read_raster(input, corner, &whole); !s.ok()) return s;
  return BandRun(*this, whole).run();
}

}  // namespace obscura::app
