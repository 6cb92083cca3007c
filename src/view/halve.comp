// Every second pixel of every second row of the geometry, as an image of its own (view/half.h).
#version 450
#extension GL_GOOGLE_include_directive : require
#define PASS_CONSTANTS         \
  int first_x, first_y;        \
  int half_width, half_height; \
  int half_left, half_top;     \
  int half_visible_width, half_visible_height;
#include "gpu/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kNormals = true;

layout(binding = 0) readonly buffer Depth { float depth[]; };
layout(binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(binding = 2) writeonly buffer HalfDepth { float half_depth[]; };
layout(binding = 3) writeonly buffer HalfNormals { vec4 half_normals[]; };

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
