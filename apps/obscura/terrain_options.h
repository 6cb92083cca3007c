#ifndef OBSCURA_APPS_OBSCURA_TERRAIN_OPTIONS_H_
#define OBSCURA_APPS_OBSCURA_TERRAIN_OPTIONS_H_

#include <string>

#include "obscura/status.h"

namespace obscura::app {

// --memory: "2G", "500M" in bytes; by default three quarters of the machine's memory.
Status parse_memory(const std::string& text, double* bytes);
// Of the command and its libraries.
inline constexpr double kProgramBytes = 80e6;
// Large arrays go back to the system when they are freed, not into holes of the heap.
void return_large_arrays();
// What --memory must be for the least part of a raster, `least` bytes.
Status too_little_memory(double bytes, const std::string& part, double least);
// --part: "I/N".
Status parse_part(const std::string& text, int* part, int* parts);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_TERRAIN_OPTIONS_H_
