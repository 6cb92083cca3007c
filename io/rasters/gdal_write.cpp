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

// Writes a part whose north-western cell lies at (x, y).
CPLErr put_part(GDALDatasetH dataset, const Georeference& r, int x, int y, const Image& part) {
  const auto nodata = static_cast<float>(nodata_of(r));
  const int height = GDALGetRasterYSize(dataset);
  std::vector<float> row(part.width);
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, static_cast<int>(c) + 1);
    const float* values = part.channels[c].values.data();
    for (int j = 0; j < part.height; ++j) {
      std::copy_n(values + static_cast<std::size_t>(j) * part.width, part.width, row.data());
      for (float& v : row) {
        if (std::isnan(v)) v = nodata;
      }
      const int to = r.south_up ? height - 1 - (y + j) : y + j;
      if (GDALRasterIO(band, GF_Write, x, to, part.width, 1, row.data(), part.width, 1, GDT_Float32,
                       0, 0) != CE_None) {
        return CE_Failure;
      }
    }
  }
  return CE_None;
}

bool describe(GDALDatasetH dataset, const Georeference& r, const std::vector<std::string>& channels,
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
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, static_cast<int>(i) + 1);
    GDALSetDescription(band, channels[i].c_str());
    if (!options.units.empty() && *options.units[i]) GDALSetRasterUnitType(band, options.units[i]);
    if (GDALSetRasterNoDataValue(band, nodata_of(r)) != CE_None) return false;
  }
  return true;
}

bool add_overviews(GDALDatasetH dataset) {
  const int side = std::max(GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset));
  std::vector<int> factors;
  for (int f = 2; side / f >= 128; f *= 2) factors.push_back(f);
  return factors.empty() ||
         GDALBuildOverviews(dataset, "AVERAGE", static_cast<int>(factors.size()), factors.data(), 0,
                            nullptr, nullptr, nullptr) == CE_None;
}

}  // namespace

Status write_geotiff(const std::string& path, const Raster& raster,
                     const std::vector<std::string>& channels, const RasterWriteOptions& options,
                     const std::function<Status(const PutPart& put)>& make) {
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
  create.set("NUM_THREADS", "ALL_CPUS");
  auto failed = [&] {
    return Status(StatusCode::kInternal,
                  fmt::format("cannot write {}: {}", path, GdalSession::message()));
  };
  Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), raster.whole_width,
                             raster.whole_height, static_cast<int>(channels.size()), GDT_Float32,
                             create.get()));
  if (!dataset || !describe(dataset.get(), r, channels, options)) return failed();
  const Status made = make([&](int x, int y, const Image& part) {
    return put_part(dataset.get(), r, x, y, part) == CE_None ? Status() : failed();
  });
  if (!made.ok()) return made;
  if (options.overviews && !add_overviews(dataset.get())) return failed();
  // The rest is written on closing, and only the last error tells how that went.
  CPLErrorReset();
  dataset.reset();
  return CPLGetLastErrorType() >= CE_Failure ? failed() : Status();
}

}  // namespace obscura::tools
