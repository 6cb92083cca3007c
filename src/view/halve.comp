// Every second pixel of every second row of the geometry, as an image of its own (view/half.h).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "view/halve_io.h"
#include "gpu/view.glsl"

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.half_width || p.y >= view.half_height) return;
  const ivec2 at = ivec2(view.first_x, view.first_y) + 2 * p;
  half_depth[p.y * view.half_width + p.x] = depth[at.y * view.width + at.x];
  if (!kNormals) return;
  const ivec2 seen = p - ivec2(view.half_left, view.half_top);
  if (seen.x < 0 || seen.y < 0 || seen.x >= view.half_visible_width ||
      seen.y >= view.half_visible_height) {
    return;
  }
  half_normals[seen.y * view.half_visible_width + seen.x] =
      normals[2 * seen.y * view.visible_width + 2 * seen.x];
}
