#include "view/normals.h"

#include <algorithm>
#include <cmath>

namespace obscura::view {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// One row of the depth image and its neighbours; a row outside the image is background.
struct Rows {
  const float* above;
  const float* here;
  const float* below;
};

// Change of depth per pixel towards the side where it is smaller (forward if equal), relative to
// the neighbour's depth in perspective; 0 where both sides are background, as if the surface faced
// the camera.
inline float depth_step(float backward, float here, float forward, bool relative) {
  const float db = here - backward, df = forward - here;
  const bool ahead = std::abs(df) <= std::abs(db);
  const float step = ahead ? df : db;
  const float scale = relative ? (ahead ? forward : backward) : 1.0f;
  return std::abs(step) < kInf ? step / scale : 0.0f;
}

}  // namespace

void compute_normals(const VectorView<const float>& given, Executor& executor, Geometry* geometry) {
  Geometry& g = *geometry;
  g.normal_x.resize(g.width, g.height);
  g.normal_y.resize(g.width, g.height);
  g.normal_z.resize(g.width, g.height);
  const Camera c = g.camera;
  const int x0 = g.guard_band.left, x1 = g.width - g.guard_band.right;
  const int y0 = g.guard_band.top, y1 = g.height - g.guard_band.bottom;
  executor.parallel_for(y1 - y0, [&](int task, int) {
    const int y = y0 + task;
    const Rows rows{y > 0 ? g.depth.row(y - 1) : nullptr, g.depth.row(y),
                    y + 1 < g.height ? g.depth.row(y + 1) : nullptr};
    float* out_x = g.normal_x.row(y);
    float* out_y = g.normal_y.row(y);
    float* out_z = g.normal_z.row(y);
    const float b = (c.center_v - (y + 0.5f)) * c.scale_y;
    for (int x = x0; x < x1; ++x) {
      const float d = rows.here[x];
      const float left = x > 0 ? rows.here[x - 1] : kInf;
      const float right = x + 1 < g.width ? rows.here[x + 1] : kInf;
      const float du = depth_step(left, d, right, !c.orthographic);
      const float dv = depth_step(rows.above ? rows.above[x] : kInf, d,
                                  rows.below ? rows.below[x] : kInf, !c.orthographic);
      const float a = (x + 0.5f - c.center_u) * c.scale_x;
      // The cross product of the two differences, divided by both neighbours' depths. With points
      // ((u-cu) sx d, (cv-v) sy d, -d) it faces the camera by construction: n.(a, b, -1) < 0.
      float nx = du * c.scale_y;
      float ny = -dv * c.scale_x;
      float nz = c.scale_x * c.scale_y + (c.orthographic ? 0.0f : a * nx + b * ny);
      if (!given.empty()) {
        const float gx = given.x(x, y), gy = given.y(x, y), gz = given.z(x, y);
        const float square = gx * gx + gy * gy + gz * gz;
        if (square > 0 && square < kInf) {
          nx = gx;
          ny = gy;
          nz = gz;
        }
      }
      const float largest = std::max({std::abs(nx), std::abs(ny), std::abs(nz)});
      const float k = 1 / largest;
      nx *= k;
      ny *= k;
      nz *= k;
      const float inverse = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
      const bool surface = d < kInf && largest > 0 && largest < kInf;
      out_x[x] = surface ? nx * inverse : 0.0f;
      out_y[x] = surface ? ny * inverse : 0.0f;
      out_z[x] = surface ? nz * inverse : 1.0f;
    }
  });
}

}  // namespace obscura::view
