// Unit normals of the visible part, given or from depth (view/normals.cpp, compute_normals).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "view/normals_leaf.h"
#include "view/normals_io.h"
#include "gpu/view.glsl"

float depth_at(int x, int y) {
  if (x < 0 || y < 0 || x >= view.width || y >= view.height) return kInf;
  return depth[y * view.width + x];
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const int x = p.x + view.left, y = p.y + view.top;
  const bool relative = view.orthographic == 0;
  const float d = depth_at(x, y);
  const float du = depth_step(depth_at(x - 1, y), d, depth_at(x + 1, y), relative);
  const float dv = depth_step(depth_at(x, y - 1), d, depth_at(x, y + 1), relative);
  const float a = (float(x) + 0.5 - view.center_u) * view.scale_x;
  const float b = (view.center_v - (float(y) + 0.5)) * view.scale_y;
  EyeNormal n = normal_of_steps(du, dv, a, b, view.scale_x, view.scale_y, relative);
  if (kGiven) {
    const vec3 given = texelFetch(normal_image, ivec2(x, y), 0).xyz;
    const float square = dot(given, given);
    if (square > 0.0 && square < kInf) n = EyeNormal(given.x, given.y, given.z);
  }
  const EyeNormal unit = unit_normal(n, d < kInf);
  normals[p.y * view.visible_width + p.x] =
      vec4(unit.x, unit.y, unit.z, 0.0);
}
