// The two views of the depth image (screen/far_field/plane.cpp, fill_plane): what is interpolated
// between texels, with a margin of background beside each row, and for the transposed one the
// receivers, tile by tile through shared memory so that reads and writes are both in rows.
#version 450
#extension GL_GOOGLE_include_directive : require
#define PASS_CONSTANTS int transposed, lattice_stride, margin;
#include "vulkan/view.glsl"

const int kTile = 32;
layout(local_size_x = 32, local_size_y = 8) in;

layout(constant_id = 0) const bool kLattice = true;  // else receivers alone

layout(binding = 0) readonly buffer Depth { float depth[]; };
layout(binding = 1) readonly buffer Receivers { vec4 receivers[]; };
layout(binding = 2) writeonly buffer Lattice { float lattice[]; };
layout(binding = 3) writeonly buffer Turned { vec4 turned_receivers[]; };
layout(binding = 4) readonly buffer Kappa { float kappa[]; };

#include "screen/far_field/far_field_lattice.glsl"

shared float texels[kTile][kTile + 1];
shared vec4 tile[kTile][kTile + 1];

void fill_rows(ivec2 corner) {
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    const ivec2 p = corner + ivec2(gl_LocalInvocationID.x, y);
    if (p.x >= view.width + 2 * view.margin || p.y >= view.height) continue;
    const int u = p.x - view.margin;
    const bool inside = u >= 0 && u < view.width;
    lattice[p.y * view.lattice_stride + p.x] =
        inside ? lattice_value(depth[p.y * view.width + u]) : 0.0;
  }
}

// `corner` is the transposed plane's, margin included.
void fill_columns(ivec2 corner) {
  const ivec2 at = ivec2(gl_LocalInvocationID.xy);
  for (int y = at.y; y < kTile; y += 8) {
    const ivec2 p = ivec2(corner.y + at.x, corner.x - view.margin + y);
    const bool inside = p.x < view.width && p.y >= 0 && p.y < view.height;
    if (kLattice) texels[at.x][y] = inside ? lattice_value(depth[p.y * view.width + p.x]) : 0.0;
    const ivec2 visible = ivec2(corner.y + at.x, corner.x + y);
    if (visible.x < view.visible_width && visible.y < view.visible_height) {
      tile[at.x][y] = receivers[visible.y * view.visible_width + visible.x];
    }
  }
  barrier();
  for (int y = at.y; y < kTile; y += 8) {
    const ivec2 p = corner + ivec2(at.x, y);
    if (kLattice && p.x < view.height + 2 * view.margin && p.y < view.width) {
      lattice[p.y * view.lattice_stride + p.x] = texels[y][at.x];
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
