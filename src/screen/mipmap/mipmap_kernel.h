#ifndef OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_KERNEL_H_
#define OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_KERNEL_H_

#include "math/falloff.h"
#include "view/geometry.h"

namespace obscura {

inline constexpr int kMaxMipmapLevels = 17;

struct MipmapLevel {
  const float* depth;  // 0: background
  int width, height;
  std::ptrdiff_t stride;
};

struct MipmapFrame {
  const view::Geometry* geometry = nullptr;
  const math::Rho* rho = nullptr;
  MipmapLevel levels[kMaxMipmapLevels] = {};
  int level_count = 0;
  int directions = 0;
  float step_factor = 0;
  bool interpolate = true;
};

// Writes the visibility of a row of the visible part; out is padded to whole vectors.
void mipmap_row(const MipmapFrame& frame, int row, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_KERNEL_H_
