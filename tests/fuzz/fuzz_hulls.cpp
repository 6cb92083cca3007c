#include <cstdint>

#include "io/rasters/hull_file.h"
#include "tests/fuzz/memory_file.h"

using namespace obscura;

// What a band of a terrain model hands on: damaged files are refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::MemoryFile file(data, size, ".hulls");
  tools::HullFile hulls(file.path(), 4);
  if (!hulls.load().ok()) return 0;
  std::vector<TerrainHullPoint> points;
  for (int sweep = 0; sweep < 2; ++sweep) {
    if (!hulls.begin(sweep).ok()) continue;
    for (int column = 0; column < 4; ++column) (void)hulls.get(column, &points);
  }
  return 0;
}
