#include "apps/obscura/terrain_options.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "obscura/settings.h"
#include "obscura/terrain.h"

namespace obscura::app {

Status parse_memory(const std::string& text, double* bytes) {
  if (text.empty()) {
    *bytes = 0.75 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
             static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return {};
  }
  double number = 0;
  const double unit = text.ends_with("G") ? 1e9 : text.ends_with("M") ? 1e6 : 0;
  if (unit > 0 && parse_number(std::string_view(text).substr(0, text.size() - 1), &number) &&
      number > 0 && std::isfinite(number)) {
    *bytes = number * unit;
    return {};
  }
  return invalid_argument(
      fmt::format("--memory is '{}'; it must be a size such as 500M or 2G", text));
}

void return_large_arrays() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

Status too_little_memory(double bytes, const std::string& part, double least) {
  return invalid_argument(fmt::format("--memory: {:.0f} MB do not hold a {}; give at least {:.0f}M",
                                      1e-6 * bytes, part, std::ceil(1e-6 * least)));
}

Status find_terrain_datum(const std::string& path, const tools::RasterOptions& options,
                          const tools::Raster& whole, double* datum) {
  *datum = 0;
  const int rows = std::max(1, (1 << 24) / whole.whole_width);
  for (int row = 0; row < whole.whole_height; row += rows) {
    tools::Raster raster;
    tools::RasterOptions strip = options;
    const int count = std::min(rows, whole.whole_height - row);
    strip.window = tools::RasterWindow{0, row, whole.whole_width, count};
    if (Status s = tools::read_raster(path, strip, &raster); !s.ok()) return s;
    const auto found = std::ranges::find_if(
        raster.heights, [](float h) { return std::fabs(h) <= kMostTerrainHeight; });
    if (found == raster.heights.end()) continue;
    *datum = *found;
    break;
  }
  return {};
}

double least_cell(const tools::Raster& whole) {
  double cell = std::min(whole.cell_width, whole.cell_height);
  for (const double width : whole.whole_row_widths) cell = std::min(cell, width);
  return cell;
}

Status parse_part(const std::string& text, int* part, int* parts) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  double i = 0, n = 0;
  if (slash != text.npos && parse_number(text.substr(0, slash), &i) &&
      parse_number(text.substr(slash + 1), &n) && i >= 1 && n <= 1e6 && i <= n &&
      i == std::floor(i) && n == std::floor(n)) {
    *part = static_cast<int>(i);
    *parts = static_cast<int>(n);
    return {};
  }
  return invalid_argument(
      fmt::format("--part is '{}'; it must be I/N with whole numbers, 1 <= I <= N", text));
}

}  // namespace obscura::app
