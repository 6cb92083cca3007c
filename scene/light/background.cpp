#include "scene/light/background.h"

#include <cmath>

namespace obscura::tools {
namespace {

bool is_background(const DepthInput& input, float depth) {
  if (!std::isfinite(depth)) return true;
  if (input.depth_kind == DepthKind::kNdc) return depth == 1;
  if (input.depth_kind == DepthKind::kNdcReversed) return depth == 0;
  return depth >= input.far_plane;
}

// The world direction of the ray through pixel (u, v).
std::array<float, 3> ray_of(const Camera& camera, int u, int v, const std::array<float, 9>& m) {
  const float away = camera.orthographic ? 0.0f : 1.0f;
  const float ray[3] = {away * (float(u) + 0.5f - camera.center_u) * camera.scale_x,
                        away * (camera.center_v - float(v) - 0.5f) * camera.scale_y, -1};
  std::array<float, 3> world{};
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) world[k] += m[3 * k + i] * ray[i];
  }
  return world;
}

}  // namespace

void fill_background(const DepthInput& input, const std::array<float, 9>& world_from_eye,
                     const Environment* environment, Image* image) {
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      const int u = x + input.guard_band.left, v = y + input.guard_band.top;
      if (!is_background(input, input.depth[std::size_t(v) * input.width + u])) continue;
      std::array<float, 3> rgb{};
      if (environment) {
        rgb = environment->radiance(ray_of(input.camera, u, v, world_from_eye));
      }
      for (int k = 0; k < 3; ++k) {
        image->channels[k].values[std::size_t(y) * image->width + x] = rgb[k];
      }
    }
  }
}

}  // namespace obscura::tools
