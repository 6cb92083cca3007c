#ifndef OBSCURA_IO_RASTERS_RASTER_H_
#define OBSCURA_IO_RASTERS_RASTER_H_

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/images/image.h"
#include "obscura/status.h"

namespace obscura::tools {

// Where a raster lies and what its file says beside: known to the reader of its format alone.
struct Georeference;

// Part of a raster, counted from its north-western cell.
struct RasterWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

// Heights of a regular grid, row 0 in the north. Cells without data are NaN.
struct Raster {
  int width = 0, height = 0;
  std::vector<float> heights;
  double cell_width = 0, cell_height = 0;  // metres; 0: the file does not say
  std::vector<double> row_widths{};        // metres, by row, where they differ (geographic grids)
  double z_factor = 1;                     // makes metres of heights
  int whole_width = 0, whole_height = 0;   // of the file, where this is a window of it
  std::vector<double> whole_row_widths{};  // of all its rows
  std::shared_ptr<const Georeference> georeference{};
};

// What a file may not say by itself.
struct RasterOptions {
  int band = 0;                          // counted from 1; 0: the only one
  std::string nodata{};                  // a number, "none", or empty: as the file says
  std::optional<double> cell_size;       // metres
  std::optional<double> z_factor{};      // makes metres of heights
  bool network = false;                  // files may lie elsewhere
  std::optional<RasterWindow> window{};  // with GDAL only; none: the whole
};

// Reads heights by the file's ending: .png (the stored integers), .exr, .pfm (their only channel),
// .npy, else with GDAL.
Status read_raster(const std::string& path, const RasterOptions& options, Raster* raster);

struct RasterWriteOptions {
  bool overviews = false;                // GeoTIFF: reduced copies for fast display
  std::string settings{};                // GeoTIFF: kept as the tag OBSCURA
  std::span<const char* const> units{};  // GeoTIFF: by channel
};

// Whether a file of this ending can hold so many results.
Status check_raster_ending(const std::string& path, int channels);

// Writes results on the raster that they come from by the ending: .tif (where this build has GDAL),
// .exr, .npy (a third, first axis where there are several), and .pfm or .png for one alone. The
// file is whole or not there.
Status write_raster(const std::string& path, const Raster& raster, const Image& results,
                    const RasterWriteOptions& options = {});

// Writes a GeoTIFF of the size of raster.whole_width x whole_height from parts: `make` calls `put`
// with one after the other and where it lies. The file is whole or not there.
using PutPart = std::function<Status(int x, int y, const Image& part)>;
Status write_raster_parts(const std::string& path, const Raster& raster,
                          const std::vector<std::string>& channels,
                          const RasterWriteOptions& options,
                          const std::function<Status(const PutPart& put)>& make);

// Parts of read_raster.
// Marks the values of --nodata, or says that the file should name them.
Status apply_nodata(const std::string& path, const RasterOptions& options, Raster* raster);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_RASTERS_RASTER_H_
