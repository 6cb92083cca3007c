#ifndef OBSCURA_APPS_OBSCURA_TERRAIN_OPTIONS_H_
#define OBSCURA_APPS_OBSCURA_TERRAIN_OPTIONS_H_

#include <string>

#include "io/rasters/raster.h"
#include "obscura/status.h"

namespace obscura::app {

// --memory: "2G", "500M" in bytes; by default three quarters of the machine's memory.
Status parse_memory(const std::string& text, double* bytes);
// Of the command and its libraries.
inline constexpr double kProgramBytes = 80e6;
// Large arrays go back to the system when they are freed, not into holes of the heap.
void return_large_arrays();
// What GDAL may keep of files of which parts so wide are read: a row of blocks, read line by line.
inline double gdal_bytes(double width) { return 64e6 + 4.0 * 640 * width; }
// What --memory must be for the least part of a raster, `least` bytes.
Status too_little_memory(double bytes, const std::string& part, double least);
// A raster's first height in the order of its rows, 0 where it has none: from which parts of it are
// to measure theirs, as the whole does. `whole`: the raster, or a window of it.
Status find_terrain_datum(const std::string& path, const tools::RasterOptions& options,
                          const tools::Raster& whole, double* datum);
// The shortest side of any cell, in metres.
double least_cell(const tools::Raster& whole);
// --part: "I/N".
Status parse_part(const std::string& text, int* part, int* parts);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_TERRAIN_OPTIONS_H_
