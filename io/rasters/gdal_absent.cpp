// In place of gdal*.cpp where the build has no GDAL.
#include "fmt/format.h"
#include "io/rasters/gdal.h"

namespace obscura::tools {
namespace {

Status absent(const std::string& path) {
  return unsupported(
      fmt::format("{}: this build has no GDAL and knows .png, .exr, .pfm and .npy; build with "
                  "OBSCURA_WITH_GDAL=ON",
                  path));
}

}  // namespace

bool has_gdal() { return false; }

void limit_gdal_memory(double) {}

Status read_gdal(const std::string& path, const RasterOptions&, Raster*) { return absent(path); }

Status write_geotiff(const std::string& path, const Raster&, const std::vector<std::string>&,
                     const RasterWriteOptions&, const std::function<Status(const PutPart& put)>&) {
  return absent(path);
}

}  // namespace obscura::tools
