#include "core/reflection_noise.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/random.h"

namespace obscura {

ReflectionNoise::ReflectionNoise(std::uint32_t seed)
    : cosines_(kSize, kSize), sines_(kSize, kSize) {
  constexpr int kBlock = 4, kStrata = kBlock * kBlock;
  Random random(seed);
  for (int by = 0; by < kSize; by += kBlock) {
    for (int bx = 0; bx < kSize; bx += kBlock) {
      int order[kStrata];
      for (int i = 0; i < kStrata; ++i) order[i] = i;
      for (int i = kStrata - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
      for (int i = 0; i < kStrata; ++i) {
        const double turn = (order[i] + random.uniform()) / kStrata;
        const int x = bx + i % kBlock, y = by + i / kBlock;
        cosines_(x, y) = static_cast<float>(std::cos(2 * std::numbers::pi * turn));
        sines_(x, y) = static_cast<float>(std::sin(2 * std::numbers::pi * turn));
      }
    }
  }
}

}  // namespace obscura
