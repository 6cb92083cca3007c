#include "obscura/patterns.h"

#include "screen/volumetric/patterns/pattern_tables.h"

namespace obscura {

std::span<const DiskSample> disk_pattern(int count, bool center) {
  const DiskSample* all = center ? math::kCenteredDisks : math::kDisks;
  return {all + count * (count - 1) / 2, static_cast<std::size_t>(count)};
}

std::span<const BallSample> ball_pattern(int count) {
  return {math::kBalls + count * (count - 1) / 2, static_cast<std::size_t>(count)};
}

}  // namespace obscura
