#include "screen/far_field/plane.h"

#include <algorithm>
#include <cmath>

#include "math/leaf_scalar.h"
#include "screen/far_field/scan.h"

namespace obscura {
namespace leaf_scalar {
#include "math/apart_leaf.h"
#include "view/taps_leaf.h"
// After taps_leaf.h.
#include "screen/far_field/lattice_leaf.h"
}  // namespace leaf_scalar

namespace far_field {
namespace {

constexpr int kTile = 32;  // rows per task; a transposed tile's lines stay in the cache

// image(u, v) = value(u, v), tile by tile: where value reads a transposed image, its lines stay in
// the cache.
template <class Value>
void fill(int width, int height, Executor& executor, PhaseImage* image, const Value& value) {
  executor.parallel_for((height + kTile - 1) / kTile, [&](int task, int) {
    const int v1 = std::min(height, (task + 1) * kTile), phases = image->phases();
    for (int u0 = 0; u0 < width; u0 += kTile * phases) {
      const int u1 = std::min(width, u0 + kTile * phases);
      for (int v = task * kTile; v < v1; ++v) {
        for (int phase = 0; phase < phases && u0 + phase < u1; ++phase) {
          float* out = image->at(v, u0 + phase);
          for (int u = u0 + phase; u < u1; u += phases) *out++ = value(u, v);
        }
      }
    }
  });
}

}  // namespace

float join_slack(const Plane& plane) {
  return leaf_scalar::slack_of_pixels(plane.scale_u, plane.scale_v);
}

void SumImages::clear(int c, int width, int height, int phases, Executor& executor) {
  channel[c].resize(width, height, 0, phases);
  executor.parallel_for(height, [&](int y, int) { channel[c].fill_row(y, 0); });
}

void fill_plane(const view::Geometry& g, const Occluder& occluder, bool transposed, int margin,
                int phases, Executor& executor, Plane* plane) {
  Plane& p = *plane;
  const Camera& c = g.camera;
  p.orthographic = c.orthographic;
  // Texel centres move to whole numbers.
  const float cu = c.center_u - 0.5f, cv = c.center_v - 0.5f;
  p.width = transposed ? g.height : g.width;
  p.height = transposed ? g.width : g.height;
  p.left = transposed ? g.guard_band.top : g.guard_band.left;
  p.top = transposed ? g.guard_band.left : g.guard_band.top;
  p.visible_width = transposed ? g.visible().height : g.visible().width;
  p.visible_height = transposed ? g.visible().width : g.visible().height;
  p.scale_u = transposed ? c.scale_y : c.scale_x;
  p.scale_v = transposed ? c.scale_x : c.scale_y;
  p.center_u = transposed ? cv : cu;
  p.center_v = transposed ? cu : cv;

  auto texel = [&](const AlignedImage<float>& image, int x, int y) {
    return transposed ? image(y, x) : image(x, y);
  };
  auto lattice = [&](PhaseImage* image, auto value) {
    image->resize(p.width, p.height, margin, phases);
    executor.parallel_for(p.height, [&](int y, int) { image->fill_row(y, 0); });
    fill(p.width, p.height, executor, image, value);
  };
  lattice(&p.lattice, [&](int x, int y) {
    return leaf_scalar::lattice_of_depth(texel(g.depth, x, y), p.orthographic);
  });
  p.finite = occluder.kind != OccluderKind::kSolid;
  if (p.finite) {
    const bool given = occluder.kind != OccluderKind::kThickness;
    lattice(&p.back, [&](int x, int y) {
      const float d = texel(g.depth, x, y);
      if (!std::isfinite(d)) return 0.0f;
      if (given) return std::min(texel(g.back_depth, x, y), leaf_scalar::kFarBack);
      const float a = (x - p.center_u) * p.scale_u, b = (y - p.center_v) * p.scale_v;
      return leaf_scalar::back_of_thickness(d, occluder.thickness, a, b, p.orthographic);
    });
  }
}

void fill_receivers(const view::Geometry& g, bool transposed, Executor& executor, Plane* plane) {
  Plane& p = *plane;
  const int phases = p.lattice.phases();
  const AlignedImage<float>* normals[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  auto texel = [&](const AlignedImage<float>& image, int u, int v) {
    return transposed ? image(v + p.top, u + p.left) : image(u + p.left, v + p.top);
  };
  auto write = [&](PhaseImage* image, auto value) {
    image->resize(p.visible_width, p.visible_height, 0, phases);
    // Whole vectors are read, so what follows a row must not stay undefined.
    executor.parallel_for(p.visible_height, [&](int y, int) { image->fill_row(y, 0); });
    fill(p.visible_width, p.visible_height, executor, image, value);
  };
  write(&p.receivers.lattice, [&](int u, int v) {
    return leaf_scalar::lattice_of_depth(texel(g.depth, u, v), p.orthographic);
  });
  // The image's v and this frame's third axis run against eye space's y and z.
  constexpr float kSign[] = {1, -1, -1};
  for (int k = 0; k < 3; ++k) {
    const int axis = transposed && k < 2 ? 1 - k : k;
    write(&p.receivers.normal[axis],
          [&](int u, int v) { return kSign[k] * texel(*normals[k], u, v); });
  }
}

}  // namespace far_field
}  // namespace obscura
