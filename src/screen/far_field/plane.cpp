#include "screen/far_field/plane.h"

#include <algorithm>
#include <cmath>

namespace obscura::far_field {
namespace {

constexpr float kFarBack = 1e12f;  // matter without end, finite so that arithmetic is
constexpr int kTile = 32;          // rows per task; a transposed tile's lines stay in the cache

// out(x, y) = value(u, v) with (u, v) = transposed ? (y, x) : (x, y), tile by tile.
template <class Row, class Value>
void fill(int width, int height, Executor& executor, Row row, Value value) {
  executor.parallel_for((height + kTile - 1) / kTile, [&](int task, int) {
    const int y0 = task * kTile, y1 = std::min(height, y0 + kTile);
    for (int x0 = 0; x0 < width; x0 += kTile) {
      const int x1 = std::min(width, x0 + kTile);
      for (int y = y0; y < y1; ++y) {
        float* out = row(y);
        for (int x = x0; x < x1; ++x) out[x] = value(x, y);
      }
    }
  });
}

}  // namespace

void MarginImage::resize(int width, int height, int margin) {
  margin_ = (margin + 15) / 16 * 16;
  image_.resize(width + 2 * margin_, height);
}

void fill_plane(const view::Geometry& g, const Occluder& occluder, bool transposed, int margin,
                Executor& executor, Plane* plane) {
  Plane& p = *plane;
  const Camera& c = g.camera;
  p.orthographic = c.orthographic;
  p.kappa = c.orthographic ? 2 * g.max_depth : 0;
  // Texel centres move to whole numbers.
  const float cu = c.center_u - 0.5f, cv = c.center_v - 0.5f;
  p.width = transposed ? g.height : g.width;
  p.height = transposed ? g.width : g.height;
  p.left = transposed ? g.guard_band.top : g.guard_band.left;
  p.top = transposed ? g.guard_band.left : g.guard_band.top;
  p.visible_width = transposed ? g.visible_height() : g.visible_width();
  p.visible_height = transposed ? g.visible_width() : g.visible_height();
  p.scale_u = transposed ? c.scale_y : c.scale_x;
  p.scale_v = transposed ? c.scale_x : c.scale_y;
  p.center_u = transposed ? cv : cu;
  p.center_v = transposed ? cu : cv;

  auto texel = [&](const AlignedImage<float>& image, int x, int y) {
    return transposed ? image(y, x) : image(x, y);
  };
  auto lattice = [&](MarginImage* image, auto value) {
    image->resize(p.width, p.height, margin);
    executor.parallel_for(p.height, [&](int y, int) {
      float* row = image->row(y);
      std::fill(row - image->margin(), row, 0.0f);
      std::fill(row + p.width, row + p.width + image->margin(), 0.0f);
    });
    fill(
        p.width, p.height, executor, [&](int y) { return image->row(y); }, value);
  };
  lattice(&p.lattice, [&](int x, int y) {
    const float d = texel(g.depth, x, y);
    if (!std::isfinite(d)) return 0.0f;
    return p.orthographic ? p.kappa - d : 1 / d;
  });
  p.finite = occluder.kind != OccluderKind::kSolid;
  if (p.finite) {
    const bool given = occluder.kind == OccluderKind::kBackDepth;
    lattice(&p.back, [&](int x, int y) {
      const float d = texel(g.depth, x, y);
      if (!std::isfinite(d)) return 0.0f;
      if (given) return std::min(texel(g.back_depth, x, y), kFarBack);
      const float a = (x - p.center_u) * p.scale_u, b = (y - p.center_v) * p.scale_v;
      const float ray = p.orthographic ? 1.0f : std::sqrt(1 + a * a + b * b);
      return std::min(d + occluder.thickness / ray, kFarBack);
    });
  }

  p.normal_u.resize(p.visible_width, p.visible_height);
  p.normal_v.resize(p.visible_width, p.visible_height);
  p.normal_w.resize(p.visible_width, p.visible_height);
  p.obscurance.resize(p.visible_width, p.visible_height);
  auto normals = [&](const AlignedImage<float>& image, float sign, AlignedImage<float>* out) {
    fill(
        p.visible_width, p.visible_height, executor, [&](int y) { return out->row(y); },
        [&](int x, int y) { return sign * texel(image, x + p.left, y + p.top); });
  };
  // The image's v and this frame's third axis run against eye space's y and z.
  normals(g.normal_x, 1, transposed ? &p.normal_v : &p.normal_u);
  normals(g.normal_y, -1, transposed ? &p.normal_u : &p.normal_v);
  normals(g.normal_z, -1, &p.normal_w);
  executor.parallel_for(p.visible_height, [&](int y, int) {
    std::fill_n(p.obscurance.row(y), p.visible_width, 0.0f);
  });
}

}  // namespace obscura::far_field
