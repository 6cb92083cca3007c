#ifndef OBSCURA_TESTS_UNIT_SCREEN_FAR_FIELD_ROUGH_FIELD_H_
#define OBSCURA_TESTS_UNIT_SCREEN_FAR_FIELD_ROUGH_FIELD_H_

#include <cstdint>
#include <limits>

#include "core/random.h"
#include "tests/property/synthetic.h"
#include "view/geometry.h"

namespace obscura::far_field {

inline constexpr float kInf = std::numeric_limits<float>::infinity();

// Surfaces at a few depths, rough, with holes to the background.
inline view::Geometry rough(int width, int height, bool orthographic, std::uint64_t seed) {
  Random random(seed);
  view::Geometry g;
  g.width = width;
  g.height = height;
  g.camera = synthetic::random_camera(width, height, orthographic, &random);
  g.depth.resize(width, height);
  g.back_depth.resize(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double depth = 4 + (x / 5 * 7 + y / 4 * 3) % 3 + 0.1 * random.uniform();
      g.depth(x, y) = random.uniform() < 0.15 ? kInf : static_cast<float>(depth);
      g.back_depth(x, y) = g.depth(x, y) + static_cast<float>(random.uniform() < 0.5 ? 0.2 : 1.3);
    }
  }
  g.max_depth = 7;
  return g;
}

}  // namespace obscura::far_field

#endif  // OBSCURA_TESTS_UNIT_SCREEN_FAR_FIELD_ROUGH_FIELD_H_
