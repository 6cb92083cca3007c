#ifndef OBSCURA_SRC_LIGHTING_PRECONVOLVE_KERNEL_H_
#define OBSCURA_SRC_LIGHTING_PRECONVOLVE_KERNEL_H_

#include <cstddef>

namespace obscura::lighting {

// The levels' half-angles are kLevelStep, 2 kLevelStep, ... pi/2.
inline constexpr int kLevels = 8;
inline constexpr float kLevelStep = 0.19634954f;  // pi/16
// One vertex of a table: for each level R, G, B and 0.
inline constexpr int kVertexFloats = 4 * kLevels;

struct ConvolutionSource {
  float x, y, z;  // unit direction
  float r, g, b;  // radiance times solid angle
  float solid_angle;
};

// A cone's softened edge: weight = clamp(slope * cos + offset, 0, 1).
struct ConvolutionLevel {
  float slope, offset;
};

struct Convolution {
  const ConvolutionSource* sources = nullptr;
  std::size_t count = 0;
  ConvolutionLevel levels[kLevels];
};

// Convolves for `count` <= kConvolutionGroup directions: x, y, z hold kConvolutionGroup each, of
// which those beyond `count` are arbitrary. out: kVertexFloats for each.
inline constexpr int kConvolutionGroup = 16;
void convolve(const Convolution& c, const float* x, const float* y, const float* z, int count,
              float* out);

}  // namespace obscura::lighting

#endif  // OBSCURA_SRC_LIGHTING_PRECONVOLVE_KERNEL_H_
