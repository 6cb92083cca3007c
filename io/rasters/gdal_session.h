#ifndef OBSCURA_IO_RASTERS_GDAL_SESSION_H_
#define OBSCURA_IO_RASTERS_GDAL_SESSION_H_

#include <gdal.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/rasters/raster.h"

namespace obscura::tools {

struct Georeference {
  double transform[6] = {0, 1, 0, 0, 0, 1};
  std::string wkt{};                // empty: none
  std::vector<std::string> tags{};  // NAME=VALUE
  std::optional<double> nodata{};
  bool south_up = false;  // the file's first row is the southern one
};

// GDAL's drivers, registered once, and its messages kept off stderr while this lives. Only drivers
// of files on disk are left, and files within files may not be elsewhere unless `network`.
class GdalSession {
 public:
  explicit GdalSession(bool network);
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  // What GDAL said last, on one line.
  static std::string message();
};

struct CloseDataset {
  using pointer = GDALDatasetH;
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

// Metres of a cell's sides and of heights, from the dataset's coordinate system and band.
Status find_units(const std::string& path, GDALDatasetH dataset, GDALRasterBandH band,
                  const RasterOptions& options, const Georeference& reference, Raster* raster);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_RASTERS_GDAL_SESSION_H_
