#include "view/normals.h"

#include <algorithm>
#include <limits>

#include "math/leaf_scalar.h"

namespace obscura {
namespace leaf_scalar {
#include "view/normals_leaf.h"
}  // namespace leaf_scalar

namespace view {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// One row of the depth image and its neighbours; a row outside the image is background.
struct Rows {
  const float* above;
  const float* here;
  const float* below;
};

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
      const float du = leaf_scalar::depth_step(left, d, right, !c.orthographic);
      const float dv = leaf_scalar::depth_step(rows.above ? rows.above[x] : kInf, d,
                                               rows.below ? rows.below[x] : kInf, !c.orthographic);
      const float a = (x + 0.5f - c.center_u) * c.scale_x;
      leaf_scalar::EyeNormal n =
          leaf_scalar::normal_of_steps(du, dv, a, b, c.scale_x, c.scale_y, !c.orthographic);
      if (!given.empty()) {
        const float gx = given.x(x, y), gy = given.y(x, y), gz = given.z(x, y);
        const float square = gx * gx + gy * gy + gz * gz;
        if (square > 0 && square < kInf) n = {gx, gy, gz};
      }
      const leaf_scalar::EyeNormal unit = leaf_scalar::unit_normal(n, d < kInf);
      out_x[x] = unit.x;
      out_y[x] = unit.y;
      out_z[x] = unit.z;
    }
  });
}

}  // namespace view
}  // namespace obscura
