#ifndef OBSCURA_SRC_FILTERS_BILATERAL_KERNEL_H_
#define OBSCURA_SRC_FILTERS_BILATERAL_KERNEL_H_

#include <cstddef>

namespace obscura {

// One row of the blur in one direction. Pixel x + k * step of the images is tap k of pixel x.
struct BilateralRow {
  const float* values = nullptr;
  const float* surface = nullptr;  // what is linear on planes; 0 or +inf is background
  std::ptrdiff_t value_step = 1, surface_step = 1;
  int first_tap = 0, last_tap = 0;  // in [-4, 4]; the taps that lie inside the image
  bool orthographic = false;
  float edge = 0;
};

// Turns depths into what is linear on planes: 1/depth, or depth in a parallel view.
void surface_row(const float* depth, int width, bool orthographic, float* surface);

// Blurs `width` pixels into `out`. Reads and writes whole vectors past the end.
void bilateral_row(const BilateralRow& row, int width, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_FILTERS_BILATERAL_KERNEL_H_
