#ifndef OBSCURA_SRC_CORE_REFLECTION_NOISE_H_
#define OBSCURA_SRC_CORE_REFLECTION_NOISE_H_

#include <cstdint>

#include "core/aligned_image.h"

namespace obscura {

// A tile of 64 x 64 random directions of the plane, for per-pixel reflections of sample patterns
// (Loos and Sloan 2010, section 4.5). Each block of 4 x 4 holds one direction from each sixteenth
// of the circle, in random order, so that a blur of that size sees all of them.
class ReflectionNoise {
 public:
  static constexpr int kSize = 64;

  ReflectionNoise() = default;
  explicit ReflectionNoise(std::uint32_t seed);

  // Row by row; aligned for vectors.
  const float* cosines() const { return cosines_.data(); }
  const float* sines() const { return sines_.data(); }

 private:
  AlignedImage<float> cosines_, sines_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_REFLECTION_NOISE_H_
