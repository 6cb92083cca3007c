#ifndef OBSCURA_SRC_SCREEN_MIPMAP_KERNEL_H_
#define OBSCURA_SRC_SCREEN_MIPMAP_KERNEL_H_

#include <span>

#include "math/falloff.h"
#include "view/geometry.h"

namespace obscura {

inline constexpr int kMaxMipmapLevels = 17;

struct MipmapLevel {
  const float* depth;  // 0: background
  int width, height;
  std::ptrdiff_t stride;
};

// A sample along every direction: how far in pixels, and between which levels it reads.
struct MipmapStep {
  float distance;
  int level;
  float blend;  // share of level + 1
};

// Unit vectors in the image of a direction's sector: its middle and its edges.
struct MipmapDirection {
  float u, v, low_u, low_v, high_u, high_v;
};

struct MipmapFrame {
  const view::Geometry* geometry = nullptr;
  const math::Rho* rho = nullptr;
  MipmapLevel levels[kMaxMipmapLevels] = {};
  int level_count = 0;
  std::span<const MipmapDirection> directions{};
  std::span<const MipmapStep> steps{};
  bool interpolate = true;
};

// Writes the visibility of a row of the visible part; out is padded to whole vectors.
void mipmap_row(const MipmapFrame& frame, int row, float* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_MIPMAP_KERNEL_H_
