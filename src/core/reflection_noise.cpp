#include "core/reflection_noise.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/random.h"

namespace obscura {
namespace {

constexpr int kBlock = 4, kStrata = kBlock * kBlock;

std::array<int, kStrata> random_order(Random* random) {
  std::array<int, kStrata> order;
  for (int i = 0; i < kStrata; ++i) order[i] = i;
  for (int i = kStrata - 1; i > 0; --i) std::swap(order[i], order[random->below(i + 1)]);
  return order;
}

}  // namespace

ReflectionNoise::ReflectionNoise(std::uint32_t seed, bool space)
    : x_(kSize, kSize), y_(kSize, kSize) {
  if (space) z_.resize(kSize, kSize);
  Random random(seed);
  for (int by = 0; by < kSize; by += kBlock) {
    for (int bx = 0; bx < kSize; bx += kBlock) {
      const std::array<int, kStrata> turns = random_order(&random), heights = random_order(&random);
      for (int i = 0; i < kStrata; ++i) {
        const double turn = 2 * std::numbers::pi * (turns[i] + random.uniform()) / kStrata;
        const double height = space ? 2 * (heights[i] + random.uniform()) / kStrata - 1 : 0;
        const double r = std::sqrt(1 - height * height);
        const int x = bx + i % kBlock, y = by + i / kBlock;
        x_(x, y) = static_cast<float>(r * std::cos(turn));
        y_(x, y) = static_cast<float>(r * std::sin(turn));
        if (space) z_(x, y) = static_cast<float>(height);
      }
    }
  }
}

}  // namespace obscura
