#include "view/tap_frame.h"

#include <algorithm>

namespace obscura::view {

float tap_radius(float radius) { return std::clamp(radius, 1e-30f, 1e30f); }

TapFrame make_tap_frame(const Geometry& g, float radius) {
  TapFrame f;
  f.depth = g.depth.data();
  if (g.has_normals) {
    f.normal_x = g.normal_x.data();
    f.normal_y = g.normal_y.data();
    f.normal_z = g.normal_z.data();
  }
  f.stride = g.depth.stride();
  f.width = g.width;
  f.height = g.height;
  f.left = g.guard_band.left;
  f.top = g.guard_band.top;
  f.camera = g.camera;
  f.radius = tap_radius(radius);
  return f;
}

}  // namespace obscura::view
