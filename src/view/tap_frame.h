#ifndef OBSCURA_SRC_VIEW_TAP_FRAME_H_
#define OBSCURA_SRC_VIEW_TAP_FRAME_H_

#include <cstddef>

#include "view/geometry.h"

namespace obscura::view {

// A converted depth field for kernels that read single texels around each pixel. Rows and columns
// are those of the whole image; all images have the same stride.
struct TapFrame {
  const float* depth = nullptr;     // row 0
  const float* normal_x = nullptr;  // null: no normals
  const float* normal_y = nullptr;
  const float* normal_z = nullptr;
  std::ptrdiff_t stride = 0;  // floats from row to row
  int width = 0, height = 0;
  int left = 0, top = 0;  // corner of the visible part
  Camera camera;
  float radius = 0;  // world units, in [1e-30, 1e30]

  // Tiles of ReflectionNoise::kSize squared, or null: the pattern is not reflected.
  const float* noise_x = nullptr;
  const float* noise_y = nullptr;
  const float* noise_z = nullptr;  // directions in space only
};

// Clamps a radius to [1e-30, 1e30]: beyond, float depths can neither resolve nor reach it.
float tap_radius(float radius);

TapFrame make_tap_frame(const Geometry& geometry, float radius);

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_TAP_FRAME_H_
