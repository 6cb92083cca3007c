// The two views of the depth image (screen/far_field/plane.cpp, fill_plane): what is interpolated
// between texels, with a margin of background beside each row, and for the transposed one the
// receivers, tile by tile through shared memory so that reads and writes are both in rows.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "math/apart_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/far_field_fill_io.h"
#include "gpu/view.glsl"

#include "screen/far_field/far_field_lattice.glsl"

shared vec2 texels[kTile][kTile + 1];
shared vec4 tile[kTile][kTile + 1];

// Where a texel's matter ends; 0 on the background.
float back_of(ivec2 p, float d) {
  if (kOccluder == kSolid || !(d < kInf)) return 0.0;
  if (kOccluder == kWithBack) return min(max(given_backs[p.y * view.width + p.x], d), kFarBack);
  const vec2 a = (vec2(p) - (vec2(view.center_u, view.center_v) - 0.5)) *
                 vec2(view.scale_x, view.scale_y);
  return back_of_thickness(d, view.thickness, a.x, a.y, view.orthographic != 0);
}

// What the lattices hold of a pixel; nothing outside the image.
vec2 texel_at(ivec2 p) {
  if (any(lessThan(p, ivec2(0))) || p.x >= view.width || p.y >= view.height) return vec2(0.0);
  const float d = depth[p.y * view.width + p.x];
  return vec2(lattice_value(d), back_of(p, d));
}

void store_texel(int at, vec2 texel) {
  lattice[at] = texel.x;
  if (kOccluder != kSolid) backs[at] = texel.y;
}

void fill_rows(ivec2 corner) {
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    const ivec2 p = corner + ivec2(gl_LocalInvocationID.x, y);
    if (p.x >= view.width + 2 * view.margin || p.y >= view.height) continue;
    store_texel(p.y * view.lattice_stride + p.x, texel_at(ivec2(p.x - view.margin, p.y)));
  }
}

// `corner` is the transposed plane's, margin included.
void fill_columns(ivec2 corner) {
  const ivec2 at = ivec2(gl_LocalInvocationID.xy);
  for (int y = at.y; y < kTile; y += 8) {
    texels[at.x][y] = texel_at(ivec2(corner.y + at.x, corner.x - view.margin + y));
    const ivec2 visible = ivec2(corner.y + at.x, corner.x + y);
    if (visible.x < view.visible_width && visible.y < view.visible_height) {
      tile[at.x][y] = receivers[visible.y * view.visible_width + visible.x];
    }
  }
  barrier();
  for (int y = at.y; y < kTile; y += 8) {
    const ivec2 p = corner + ivec2(at.x, y);
    if (p.x < view.height + 2 * view.margin && p.y < view.width) {
      store_texel(p.y * view.lattice_stride + p.x, texels[y][at.x]);
    }
    if (p.x < view.visible_height && p.y < view.visible_width) {
      turned_receivers[p.y * view.visible_height + p.x] = tile[y][at.x];
    }
  }
}

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile;
  if (view.transposed != 0) {
    fill_columns(corner);
  } else {
    fill_rows(corner);
  }
}
