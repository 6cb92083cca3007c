// Writes a rough elevation model of any size row by row, as floats with a header that GDAL reads.
// usage: obscura_terrain_model CELLS FILE.bin
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tests/reference/terrain.h"

int main(int argc, char** argv) {
  const int side = argc == 3 ? std::atoi(argv[1]) : 0;
  if (side < 1) {
    std::fputs("usage: obscura_terrain_model CELLS FILE.bin\n", stderr);
    return 2;
  }
  const std::string path = argv[2];
  // Mountains that come again every 1024 cells, on swells of 30 km that do not.
  constexpr int kPeriod = 1024;
  const auto mountains = obscura::reference::mountains(kPeriod, kPeriod, 30, 1200);
  std::ofstream out(path, std::ios::binary);
  std::vector<float> row(side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      row[x] = mountains(x % kPeriod, y % kPeriod) +
               800 * std::sin(2.1e-3f * float(x)) * std::cos(1.7e-3f * float(y));
    }
    out.write(reinterpret_cast<const char*>(row.data()), std::streamsize(row.size() * 4));
  }
  std::ofstream(path + ".hdr") << "ENVI\nsamples = " << side << "\nlines = " << side
                               << "\nbands = 1\nheader offset = 0\ndata type = 4\ninterleave = bsq"
                                  "\nbyte order = 0\nmap info = {Arbitrary, 1, 1, 0, 0, 30, 30, 0}"
                                  "\n";
  out.close();
  return out.good() ? 0 : 1;
}
