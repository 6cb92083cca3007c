#ifndef OBSCURA_SRC_CORE_REFLECTION_NOISE_H_
#define OBSCURA_SRC_CORE_REFLECTION_NOISE_H_

#include <cstdint>

#include "core/aligned_image.h"

namespace obscura {

// A tile of 64 x 64 random unit vectors of the plane or of space, for per-pixel reflections of
// sample patterns (Loos and Sloan 2010, section 4.5). Each block of 4 x 4 holds one vector from
// each sixteenth of the circle, and, in space, of the sphere's height, in random orders, so that a
// blur of that size sees all of them.
class ReflectionNoise {
 public:
  static constexpr int kSize = 64;

  ReflectionNoise() = default;  // none: null pointers
  explicit ReflectionNoise(std::uint32_t seed, bool space = false);

  // Row by row; aligned for vectors. z is there in space only.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }

 private:
  AlignedImage<float> x_, y_, z_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_CORE_REFLECTION_NOISE_H_
