#ifndef OBSCURA_IO_RASTERS_GDAL_H_
#define OBSCURA_IO_RASTERS_GDAL_H_

#include "io/rasters/raster.h"

namespace obscura::tools {

// Whether this build reads and writes geographic rasters.
bool has_gdal();

// Bounds what GDAL keeps of the files that it reads and writes.
void limit_gdal_memory(double bytes);

// Any raster file that GDAL reads from this machine's disks: GeoTIFF, COG, VRT, ASCII grids and
// some twenty more. Scale, offset, nodata and masks are applied; rows that come from the south are
// turned. Rotated rasters are refused, and names of things in a network unless options.network.
Status read_gdal(const std::string& path, const RasterOptions& options, Raster* raster);

// GeoTIFF: a float32 band per channel in tiles of 256x256, compressed, BigTIFF where needed; with
// the transform, coordinate system and tags of the raster's own file, and its nodata value where no
// result can have it, else NaN. Not atomic by itself: see write_raster.
Status write_geotiff(const std::string& path, const Raster& raster,
                     const std::vector<std::string>& channels, const RasterWriteOptions& options,
                     const std::function<Status(const PutPart& put)>& make);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_RASTERS_GDAL_H_
