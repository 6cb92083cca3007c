#include "bench/bench_input.h"

#include <algorithm>
#include <cmath>

namespace obscura::bench {

// A floor, a far wall and rows of spheres, all of them ray-traced in closed form.
support::DepthInput bench_input(int width, int height) {
  support::DepthInput input;
  input.name = "spheres";
  input.width = width;
  input.height = height;
  input.scene_size = 24;
  input.camera = Camera::perspective(1.0f, width, height);
  input.depth.resize(static_cast<std::size_t>(width) * height);
  const Camera& c = input.camera;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double a = (x + 0.5 - c.center_u) * c.scale_x, b = (c.center_v - y - 0.5) * c.scale_y;
      double depth = 26;
      if (b < 0) depth = std::min(depth, -1.5 / b);
      for (int i = 0; i < 30; ++i) {
        // Centre (cx, cy, -cz): |t (a, b, 1) - (cx, cy, cz)| = r.
        const double cx = -6 + 2.4 * (i % 6) + 0.3 * (i / 6), cy = -1 + 0.3 * (i % 4);
        const double cz = 5 + 4 * (i / 6), r = 0.7 + 0.1 * (i % 3);
        const double square = a * a + b * b + 1, along = a * cx + b * cy + cz;
        const double rest = along * along - square * (cx * cx + cy * cy + cz * cz - r * r);
        if (rest > 0) depth = std::min(depth, (along - std::sqrt(rest)) / square);
      }
      input.depth[static_cast<std::size_t>(y) * width + x] = static_cast<float>(depth);
    }
  }
  return input;
}

}  // namespace obscura::bench
