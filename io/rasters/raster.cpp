#include "io/rasters/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fmt/format.h"
#include "io/images/files.h"
#include "io/images/pfm.h"
#include "io/images/png.h"
#include "io/rasters/gdal.h"
#include "io/rasters/npy.h"
#include "obscura/settings.h"

namespace obscura::tools {
namespace {

bool is_image(const std::string& ending) {
  return ending == ".png" || ending == ".exr" || ending == ".pfm" || ending == ".npy";
}

Status read_image_heights(const std::string& path, Image* image) {
  const std::string ending = file_ending(path);
  if (ending == ".exr") return read_image(path, image);
  std::string bytes;
  if (Status s = read_bytes(path, &bytes); !s.ok()) return s;
  if (ending == ".npy") return decode_npy(bytes, path, image);
  if (ending == ".pfm") return decode_pfm(bytes, path, image);
  bool sixteen = false;
  if (Status s = decode_png(bytes, path, image, &sixteen); !s.ok()) return s;
  // Heights are the integers as they are stored.
  for (Image::Channel& c : image->channels) {
    for (float& v : c.values) v = std::round(v * (sixteen ? 65535.0f : 255.0f));
  }
  return {};
}

// Sides that neither the file nor the user gives have no default.
Status check_cells(const std::string& path, const RasterOptions& options, Raster* raster) {
  if (options.cell_size) {
    raster->cell_width = raster->cell_height = *options.cell_size;
    raster->row_widths.clear();
    raster->whole_row_widths.clear();
  }
  if (options.z_factor) raster->z_factor = *options.z_factor;
  if (raster->cell_width > 0 && raster->cell_height > 0) return {};
  return invalid_argument(
      fmt::format("{} does not say how large its cells are; give --cell-size in metres", path));
}

}  // namespace

Status apply_nodata(const std::string& path, const RasterOptions& options, Raster* raster) {
  if (options.nodata == "none") return {};
  if (options.nodata.empty()) {
    for (const float usual : {-9999.0f, -32768.0f, -32767.0f}) {
      if (std::find(raster->heights.begin(), raster->heights.end(), usual) ==
          raster->heights.end()) {
        continue;
      }
      return invalid_argument(fmt::format(
          "{} has cells of {}, which usually means no data, and does not say so; give --nodata {} "
          "or, if they are heights, --nodata none",
          path, usual, usual));
    }
    return {};
  }
  double value = 0;
  if (!parse_number(options.nodata, &value)) {
    return invalid_argument(
        fmt::format("--nodata is '{}'; it must be a number or none", options.nodata));
  }
  const auto nodata = static_cast<float>(value);
  for (float& h : raster->heights) {
    if (h == nodata) h = std::numeric_limits<float>::quiet_NaN();
  }
  return {};
}

Status read_raster(const std::string& path, const RasterOptions& options, Raster* raster) {
  if (!is_image(file_ending(path))) {
    Raster result;
    if (Status s = read_gdal(path, options, &result); !s.ok()) return s;
    if (Status s = check_cells(path, options, &result); !s.ok()) return s;
    *raster = std::move(result);
    return {};
  }
  if (options.window) {
    return unsupported(
        fmt::format("{} is read as a whole only; tiles need a raster that GDAL reads", path));
  }
  Image image;
  if (Status s = read_image_heights(path, &image); !s.ok()) return s;
  const int channels = static_cast<int>(image.channels.size());
  if (options.band > channels) {
    return invalid_argument(
        fmt::format("--band is {}; {} has channels 1 to {}", options.band, path, channels));
  }
  if (channels > 1 && options.band == 0) {
    return invalid_argument(
        fmt::format("{} has {} channels; say which holds heights by --band", path, channels));
  }
  Raster result;
  result.width = image.width;
  result.height = image.height;
  result.heights = std::move(image.channels[std::max(0, options.band - 1)].values);
  if (Status s = check_cells(path, options, &result); !s.ok()) return s;
  if (Status s = apply_nodata(path, options, &result); !s.ok()) return s;
  *raster = std::move(result);
  return {};
}

Status check_raster_ending(const std::string& path, int channels) {
  const std::string ending = file_ending(path);
  if (ending == ".tif" || ending == ".tiff") {
    if (has_gdal()) return {};
    return unsupported(
        fmt::format("--output {}: this build has no GDAL; write .exr, .npy, .pfm or .png", path));
  }
  if (!is_image(ending)) {
    return invalid_argument(
        fmt::format("--output is '{}'; it must end in .tif, .exr, .npy, .pfm or .png", path));
  }
  if (channels > 1 && (ending == ".pfm" || ending == ".png")) {
    return invalid_argument(
        fmt::format("--output {} can hold one result; write .tif, .exr or .npy", path));
  }
  return {};
}

Status write_raster_parts(const std::string& path, const Raster& raster,
                          const std::vector<std::string>& channels,
                          const RasterWriteOptions& options,
                          const std::function<Status(const PutPart& put)>& make) {
  return write_atomically(path, [&](const std::string& temporary) {
    return write_geotiff(temporary, raster, channels, options, make);
  });
}

Status write_raster(const std::string& path, const Raster& raster, const Image& results,
                    const RasterWriteOptions& options) {
  const std::string ending = file_ending(path);
  if (ending == ".npy") {
    std::string bytes;
    encode_npy(results, &bytes);
    return write_text(path, bytes);
  }
  if (is_image(ending)) return write_image(path, results, {.png_bits = 16});
  Raster place;
  place.georeference = raster.georeference;
  place.whole_width = results.width;
  place.whole_height = results.height;
  std::vector<std::string> channels;
  for (const Image::Channel& c : results.channels) channels.push_back(c.name);
  return write_raster_parts(path, place, channels, options,
                            [&](const PutPart& put) { return put(0, 0, results); });
}

}  // namespace obscura::tools
