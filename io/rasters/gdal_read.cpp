#include <cpl_string.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "fmt/format.h"
#include "io/images/atomic_file.h"
#include "io/rasters/gdal.h"
#include "io/rasters/gdal_session.h"

namespace obscura::tools {
namespace {

bool elsewhere(const std::string& name) {
  constexpr const char* parts[] = {"://",      "/vsicurl", "/vsis3",    "/vsigs",   "/vsiaz",
                                   "/vsiadls", "/vsioss",  "/vsiswift", "/vsihdfs", "/vsiwebhdfs"};
  for (const char* part : parts) {
    if (name.find(part) != std::string::npos) return true;
  }
  return false;
}

Status check_local(const std::string& path) {
  if (elsewhere(path)) {
    return invalid_argument(fmt::format(
        "{} lies in a network; download it first, or give --network to read it from there", path));
  }
  return std::filesystem::is_directory(path) ? Status() : check_readable(path);
}

Status open(const std::string& path, const RasterOptions& options, Dataset* dataset) {
  if (!options.network) {
    if (Status s = check_local(path); !s.ok()) return s;
  }
  dataset->reset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                            nullptr, nullptr, nullptr));
  if (!*dataset) {
    return invalid_input(
        fmt::format("{}: not a raster that GDAL can read ({})", path, GdalSession::message()));
  }
  char** files = GDALGetFileList(dataset->get());
  std::string remote;
  for (char** f = files; f && *f; ++f) {
    if (elsewhere(*f)) remote = *f;
  }
  CSLDestroy(files);
  if (!options.network && !remote.empty()) {
    return invalid_argument(fmt::format(
        "{} refers to {}, which lies in a network; give --network to read it from there", path,
        remote));
  }
  return {};
}

Status choose_band(const std::string& path, GDALDatasetH dataset, int wanted,
                   GDALRasterBandH* band) {
  int count = GDALGetRasterCount(dataset);
  if (count == 0) return invalid_input(fmt::format("{} has no raster band", path));
  if (wanted > count) {
    return invalid_argument(fmt::format("--band is {}; {} has bands 1 to {}", wanted, path, count));
  }
  // An alpha band is a mask.
  if (wanted == 0 && count > 1 &&
      GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, count)) == GCI_AlphaBand) {
    --count;
  }
  if (wanted == 0 && count > 1) {
    return invalid_argument(
        fmt::format("{} has {} bands; say which holds heights by --band", path, count));
  }
  *band = GDALGetRasterBand(dataset, wanted > 0 ? wanted : 1);
  if (GDALDataTypeIsComplex(GDALGetRasterDataType(*band))) {
    return invalid_input(fmt::format("{} holds complex numbers, which are no heights", path));
  }
  return {};
}

// GDAL believes a header of a few bytes that says it is as large as a country; the machine does
// not.
Status check_memory(const std::string& path, int width, int height) {
  const double needed = 5.0 * sizeof(float) * width * height;
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (needed <= memory) return {};
  return invalid_input(fmt::format(
      "{} says that it is {}x{} cells; computing that takes {:.0f} GB, more than this machine has; "
      "--memory computes it in tiles",
      path, width, height, needed * 1e-9));
}

Status read_transform(const std::string& path, GDALDatasetH dataset, Georeference* r) {
  const bool placed = GDALGetGeoTransform(dataset, r->transform) == CE_None;
  const double* t = r->transform;
  for (int i = 0; i < 6; ++i) {
    if (!std::isfinite(t[i])) {
      return invalid_input(fmt::format("{}: its transform holds {}", path, t[i]));
    }
  }
  if (t[2] != 0 || t[4] != 0) {
    return invalid_input(fmt::format(
        "{} is rotated against its coordinate system; turn it first, as with gdalwarp", path));
  }
  if (placed && (t[1] <= 0 || t[5] == 0)) {
    return invalid_input(
        fmt::format("{}: its cells are {} wide and {} high; they must run from west to east", path,
                    t[1], t[5]));
  }
  r->south_up = placed && t[5] > 0;
  return {};
}

void read_tags(GDALDatasetH dataset, GDALRasterBandH band, Georeference* r) {
  const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
  if (system) r->wkt = GDALGetProjectionRef(dataset);
  char** tags = GDALGetMetadata(dataset, nullptr);
  for (char** t = tags; t && *t; ++t) r->tags.emplace_back(*t);
  int has = 0;
  const double nodata = GDALGetRasterNoDataValue(band, &has);
  if (has) r->nodata = nodata;
}

// Blocks that are not in a file are zeros to GDAL, where the file names no other value: a header
// that says it has more rows than it has, or a mosaic with gaps.
Status check_blocks(const std::string& path, GDALRasterBandH band, const RasterWindow& window) {
  const int coverage =
      GDALGetDataCoverageStatus(band, window.x, window.y, window.width, window.height,
                                GDAL_DATA_COVERAGE_STATUS_EMPTY, nullptr);
  if ((coverage & GDAL_DATA_COVERAGE_STATUS_EMPTY) == 0) return {};
  return invalid_input(
      fmt::format("{} lacks some of the cells that it says it has; give --nodata 0 if there are "
                  "none, or --nodata none if they are heights of 0",
                  path));
}

// Rows as doubles, so that integers of any size and scaled ones keep their values until they are
// heights.
Status read_rows(const std::string& path, GDALRasterBandH band, const RasterOptions& options,
                 const RasterWindow& window, bool south_up, Raster* raster) {
  const int width = raster->width;
  const double scale = GDALGetRasterScale(band, nullptr);
  const double offset = GDALGetRasterOffset(band, nullptr);
  const bool masked = options.nodata.empty() && (GDALGetMaskFlags(band) & GMF_ALL_VALID) == 0;
  const GDALRasterBandH mask = masked ? GDALGetMaskBand(band) : nullptr;
  std::vector<double> row(width);
  std::vector<unsigned char> valid(width, 255);
  const float none = std::numeric_limits<float>::quiet_NaN();
  float* to = raster->heights.data();
  for (int y = window.y; y < window.y + window.height; ++y) {
    const int from = south_up ? raster->whole_height - 1 - y : y;
    if (GDALRasterIO(band, GF_Read, window.x, from, width, 1, row.data(), width, 1, GDT_Float64, 0,
                     0) != CE_None ||
        (mask && GDALRasterIO(mask, GF_Read, window.x, from, width, 1, valid.data(), width, 1,
                              GDT_Byte, 0, 0) != CE_None)) {
      return invalid_input(
          fmt::format("{}: row {} cannot be read ({})", path, from, GdalSession::message()));
    }
    for (int x = 0; x < width; ++x) {
      *to++ = valid[x] ? static_cast<float>(row[x] * scale + offset) : none;
    }
  }
  return {};
}

}  // namespace

bool has_gdal() { return true; }

void limit_gdal_memory(double bytes) { GDALSetCacheMax64(static_cast<GIntBig>(bytes)); }

Status read_gdal(const std::string& path, const RasterOptions& options, Raster* raster) {
  const GdalSession session(options.network);
  Dataset dataset;
  if (Status s = open(path, options, &dataset); !s.ok()) return s;
  GDALRasterBandH band = nullptr;
  if (Status s = choose_band(path, dataset.get(), options.band, &band); !s.ok()) return s;
  Raster result;
  result.width = result.whole_width = GDALGetRasterBandXSize(band);
  result.height = result.whole_height = GDALGetRasterBandYSize(band);
  auto reference = std::make_shared<Georeference>();
  if (Status s = read_transform(path, dataset.get(), reference.get()); !s.ok()) return s;
  read_tags(dataset.get(), band, reference.get());
  if (Status s = find_units(path, dataset.get(), band, options, *reference, &result); !s.ok()) {
    return s;
  }
  const RasterWindow window =
      options.window.value_or(RasterWindow{0, 0, result.width, result.height});
  if (Status s = check_memory(path, window.width, window.height); !s.ok()) return s;
  result.width = window.width;
  result.height = window.height;
  if (!result.row_widths.empty()) {
    result.whole_row_widths = result.row_widths;
    const auto first = result.row_widths.begin() + window.y;
    result.row_widths = std::vector<double>(first, first + window.height);
  }
  const bool knows_nodata = reference->nodata || (GDALGetMaskFlags(band) & GMF_ALL_VALID) == 0;
  if (!knows_nodata && options.nodata.empty()) {
    if (Status s = check_blocks(path, band, window); !s.ok()) return s;
  }
  result.heights.resize(static_cast<std::size_t>(result.width) * result.height);
  if (Status s = read_rows(path, band, options, window, reference->south_up, &result); !s.ok()) {
    return s;
  }
  result.georeference = std::move(reference);
  RasterOptions nodata = options;
  if (knows_nodata && nodata.nodata.empty()) nodata.nodata = "none";
  if (Status s = apply_nodata(path, nodata, &result); !s.ok()) return s;
  *raster = std::move(result);
  return {};
}

}  // namespace obscura::tools
