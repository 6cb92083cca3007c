// 32 lines against the volume integral itself, by brute force.
#include <gtest/gtest.h>

#include <cmath>

#include "obscura/obscura.h"
#include "scene/scenes/load_scene.h"
#include "view/geometry.h"

namespace obscura {
namespace {

// Share of the half-sphere (x, y parallel to the image plane) that is in front of the depth image:
// a fine grid of points, each compared with its nearest texel by height above the tangent plane.
double integral(const view::Geometry& g, int x, int y, double radius) {
  constexpr int kGrid = 48;
  const Camera& c = g.camera;
  const double z = g.depth(x, y);
  const double nx = g.normal_x(x, y), ny = g.normal_y(x, y), nz = g.normal_z(x, y);
  const double a = (x + 0.5 - c.center_u) * c.scale_x, b = (c.center_v - y - 0.5) * c.scale_y;
  double free = 0, all = 0;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const double sx = -1 + (i + 0.5) * 2 / kGrid, sy = -1 + (j + 0.5) * 2 / kGrid;
      const double square = 1 - sx * sx - sy * sy;
      if (square <= 0) continue;
      const double zs = std::sqrt(square);
      const int u = std::clamp(x + int(std::lrint(radius * sx / (c.scale_x * z))), 0, g.width - 1);
      const int v = std::clamp(y - int(std::lrint(radius * sy / (c.scale_y * z))), 0, g.height - 1);
      const double ta = (u + 0.5 - c.center_u) * c.scale_x;
      const double tb = (c.center_v - v - 0.5) * c.scale_y;
      const double slope = nx * ta + ny * tb - nz;
      for (int k = 0; k < kGrid; ++k) {
        // Depths along the texel's ray.
        const double offset = (-1 + (k + 0.5) * 2 / kGrid) * zs;
        const double depth = z + radius * offset;
        const double height = depth * slope - z * (nx * a + ny * b - nz);
        if (height < 0) continue;
        all += zs;
        free += depth < g.depth(u, v) ? zs : 0;
      }
    }
  }
  return all > 0 ? free / all : 1;
}

TEST(VolumeIntegral, ThirtyTwoLinesAgreeWithinOnePerCent) {
  for (const char* name : {"hall", "meadow"}) {
    tools::DepthInput input;
    ASSERT_TRUE(tools::load_scene(std::string("scene:") + name + "?size=320x180", &input).ok());
    const DepthField field = input.field();
    view::Geometry g;
    ASSERT_TRUE(view::convert(field, {.normals = true, .works_without_normals = true},
                              *make_executor(1), &g)
                    .ok());
    for (const double share : {0.02, 0.1}) {
      LineSettings s;
      s.falloff.radius = static_cast<float>(share * input.scene_size);
      s.samples = 32;
      s.blur = false;
      const int width = field.visible().width, height = field.visible().height;
      std::vector<float> v(static_cast<std::size_t>(width) * height);
      ASSERT_TRUE(compute(field, s, {.visibility = {v.data(), width, height}}).ok());
      double lines = 0, truth = 0;
      int pixels = 0;
      for (int y = 5; y < height; y += 11) {
        for (int x = 3; x < width; x += 13) {
          const int u = x + g.guard_band.left, w = y + g.guard_band.top;
          if (!std::isfinite(g.depth(u, w))) continue;
          lines += v[static_cast<std::size_t>(y) * width + x];
          truth += integral(g, u, w, s.falloff.radius);
          ++pixels;
        }
      }
      ASSERT_GT(pixels, 100);
      EXPECT_NEAR(lines / pixels, truth / pixels, 0.01) << name << ", " << share;
    }
  }
}

}  // namespace
}  // namespace obscura
