#ifndef OBSCURA_TESTS_PROPERTY_SYNTHETIC_H_
#define OBSCURA_TESTS_PROPERTY_SYNTHETIC_H_

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"
#include "obscura/depth_field.h"

namespace obscura::synthetic {

// A depth image that owns its pixels.
struct Input {
  int width = 0, height = 0;
  std::vector<float> depth;
  std::vector<float> normals;  // interleaved; empty: to be reconstructed
  Camera camera;
  GuardBand guard_band;

  DepthField field() const {
    DepthField f;
    f.depth = {depth.data(), width, height};
    f.camera = camera;
    f.guard_band = guard_band;
    if (!normals.empty()) {
      f.normals = VectorView<const float>::interleaved(normals.data(), width, height);
    }
    return f;
  }
  Extent visible() const { return field().visible(); }
};

// The plane n.P = n.(0, 0, -distance) (n unit, n.z > 0) seen by a camera. Rays that miss it are
// background.
inline Input plane(int width, int height, const Camera& camera, double nx, double ny, double nz,
                   double distance) {
  Input in{width, height, {}, {}, camera, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double a = (x + 0.5 - camera.center_u) * camera.scale_x;
      const double b = (camera.center_v - y - 0.5) * camera.scale_y;
      const double divisor = nz - (camera.orthographic ? 0 : nx * a + ny * b);
      const double t =
          camera.orthographic ? distance + (nx * a + ny * b) / nz : nz * distance / divisor;
      const bool hit = t > 0 && divisor > 0;
      in.depth.push_back(hit ? static_cast<float>(t) : std::numeric_limits<float>::infinity());
      for (double n : {nx, ny, nz}) in.normals.push_back(static_cast<float>(n));
    }
  }
  return in;
}

// Perspective or parallel, with oblong pixels and the axis anywhere near the image.
inline Camera random_camera(int width, int height, bool orthographic, Random* random) {
  Camera c;
  c.orthographic = orthographic;
  c.scale_x = static_cast<float>((orthographic ? 6.0 : 1.2) / width);
  c.scale_y = static_cast<float>(c.scale_x * (0.7 + 0.6 * random->uniform()));
  c.center_u = static_cast<float>((1.6 * random->uniform() - 0.3) * width);
  c.center_v = static_cast<float>((1.6 * random->uniform() - 0.3) * height);
  return c;
}

// Waves with blocks in front of them and holes to the background.
inline Input blocks(int width, int height, const Camera& camera, std::uint64_t seed) {
  Input in{width, height, {}, {}, camera, {}};
  Random random(seed);
  in.depth.resize(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      in.depth[static_cast<std::size_t>(y) * width + x] =
          static_cast<float>(5 + 0.2 * std::sin(0.3 * x) * std::cos(0.2 * y));
    }
  }
  for (int i = 0; i < 12; ++i) {
    const int x0 = random.below(width), y0 = random.below(height);
    const int x1 = std::min(width, x0 + 1 + random.below(width / 4 + 1));
    const int y1 = std::min(height, y0 + 1 + random.below(height / 4 + 1));
    const float z = i % 4 == 3 ? std::numeric_limits<float>::infinity()
                               : static_cast<float>(3.5 + random.uniform());
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) in.depth[static_cast<std::size_t>(y) * width + x] = z;
    }
  }
  return in;
}

}  // namespace obscura::synthetic

#endif  // OBSCURA_TESTS_PROPERTY_SYNTHETIC_H_
