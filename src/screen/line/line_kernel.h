#ifndef OBSCURA_SRC_SCREEN_LINE_LINE_KERNEL_H_
#define OBSCURA_SRC_SCREEN_LINE_LINE_KERNEL_H_

#include <cstddef>
#include <cstdint>

namespace obscura {

inline constexpr int kMaxLineSamples = 32;
inline constexpr int kNoiseSize = 64;  // side of the tile of random reflections

// One frame of line sampling as the kernel sees it. Rows and columns count from the whole image.
struct LineFrame {
  const float* depth = nullptr;     // row 0; the rows' distance in floats is `stride`
  const float* normal_x = nullptr;  // null: no normals; same stride as depth
  const float* normal_y = nullptr;
  const float* normal_z = nullptr;
  std::ptrdiff_t stride = 0;
  int width = 0, height = 0;
  int left = 0, top = 0;  // corner of the visible part

  bool orthographic = false;
  float scale_x = 0, scale_y = 0, center_u = 0, center_v = 0;

  float radius = 0;     // in [1e-30, 1e30]: no arithmetic on it overflows
  float thickness = 0;  // 0: solid
  bool quadratic = false;

  // The pattern on the unit disk, y down. Lengths along the lines are in world units where rho is
  // constant, which saves a multiplication per tap, and in radii where it is quadratic.
  int samples = 0;
  float x[kMaxLineSamples] = {}, y[kMaxLineSamples] = {};
  float lateral[kMaxLineSamples] = {};  // sqrt(x^2 + y^2)
  float extent[kMaxLineSamples] = {};   // zs = sqrt(1 - x^2 - y^2), in the lines' unit
  float half[kMaxLineSamples] = {};     // integral of rho from 0 to zs
  float weight[kMaxLineSamples] = {};   // w_i / sum w / (2 half_i)

  // Cosines and sines of the random reflections' angles; null: the pattern as it is.
  const float* noise_cos = nullptr;
  const float* noise_sin = nullptr;
};

// Writes the visibility of the visible pixels [begin, end) of visible row `row` to out[0...].
// Background pixels get 1. `begin` is a multiple of 64.
void line_row(const LineFrame& frame, int row, int begin, int end, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_LINE_LINE_KERNEL_H_
