#include <cpl_error.h>
#include <cpl_string.h>

#include <cmath>

#include "fmt/format.h"
#include "io/rasters/gdal.h"
#include "io/rasters/gdal_session.h"

namespace obscura::tools {
namespace {

class Options {
 public:
  ~Options() { CSLDestroy(list_); }
  void set(const char* name, const char* value) { list_ = CSLSetNameValue(list_, name, value); }
  char** get() const { return list_; }

 private:
  char** list_ = nullptr;
};

// No result lies beyond 180; a number that float32 holds.
double nodata_of(const Georeference& r) {
  const bool usable = r.nodata && std::fabs(*r.nodata) > 180 &&
                      static_cast<double>(static_cast<float>(*r.nodata)) == *r.nodata;
  return usable ? *r.nodata : std::nan("");
}

CPLErr write_band(GDALRasterBandH band, const Image& results, int channel, const Georeference& r) {
  const double nodata = nodata_of(r);
  if (GDALSetRasterNoDataValue(band, nodata) != CE_None) return CE_Failure;
  std::vector<float> row(results.width);
  const float* values = results.channels[channel].values.data();
  for (int y = 0; y < results.height; ++y) {
    const int from = r.south_up ? results.height - 1 - y : y;
    std::copy_n(values + static_cast<std::size_t>(from) * results.width, results.width, row.data());
    for (float& v : row) {
      if (std::isnan(v)) v = static_cast<float>(nodata);
    }
    if (GDALRasterIO(band, GF_Write, 0, y, results.width, 1, row.data(), results.width, 1,
                     GDT_Float32, 0, 0) != CE_None) {
      return CE_Failure;
    }
  }
  return CE_None;
}

bool write_all(GDALDatasetH dataset, const Georeference& r, const Image& results,
               const RasterWriteOptions& options) {
  double* transform = const_cast<double*>(r.transform);
  if (GDALSetGeoTransform(dataset, transform) != CE_None) return false;
  if (!r.wkt.empty() && GDALSetProjection(dataset, r.wkt.c_str()) != CE_None) return false;
  for (const std::string& tag : r.tags) {
    const std::size_t equals = tag.find('=');
    if (equals == std::string::npos) continue;
    GDALSetMetadataItem(dataset, tag.substr(0, equals).c_str(), tag.c_str() + equals + 1, nullptr);
  }
  if (!options.settings.empty()) {
    GDALSetMetadataItem(dataset, "OBSCURA", options.settings.c_str(), nullptr);
  }
  const int bands = static_cast<int>(results.channels.size());
  for (int i = 0; i < bands; ++i) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, i + 1);
    GDALSetDescription(band, results.channels[i].name.c_str());
    if (!options.units.empty() && *options.units[i]) GDALSetRasterUnitType(band, options.units[i]);
    if (write_band(band, results, i, r) != CE_None) return false;
  }
  if (!options.overviews) return true;
  std::vector<int> factors;
  for (int f = 2; std::max(results.width, results.height) / f >= 128; f *= 2) factors.push_back(f);
  return factors.empty() ||
         GDALBuildOverviews(dataset, "AVERAGE", static_cast<int>(factors.size()), factors.data(), 0,
                            nullptr, nullptr, nullptr) == CE_None;
}

}  // namespace

Status write_geotiff(const std::string& path, const Raster& raster, const Image& results,
                     const RasterWriteOptions& options) {
  const GdalSession session(false);
  const Georeference nowhere;
  const Georeference& r = raster.georeference ? *raster.georeference : nowhere;
  Options create;
  create.set("TILED", "YES");
  create.set("COMPRESS", "DEFLATE");
  create.set("PREDICTOR", "3");
  create.set("ZLEVEL", "3");
  create.set("BIGTIFF", "IF_SAFER");
  create.set("INTERLEAVE", "BAND");
  auto failed = [&] {
    return Status(StatusCode::kInternal,
                  fmt::format("cannot write {}: {}", path, GdalSession::message()));
  };
  Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), results.width,
                             results.height, static_cast<int>(results.channels.size()), GDT_Float32,
                             create.get()));
  if (!dataset || !write_all(dataset.get(), r, results, options)) return failed();
  // The rest is written on closing, and only the last error tells how that went.
  CPLErrorReset();
  dataset.reset();
  return CPLGetLastErrorType() >= CE_Failure ? failed() : Status();
}

}  // namespace obscura::tools
