// Unit normals of the visible part, given or from depth (view/normals.cpp, compute_normals).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "view/normals_io.h"
#include "gpu/view.glsl"

float depth_at(int x, int y) {
  if (x < 0 || y < 0 || x >= view.width || y >= view.height) return kInf;
  return depth[y * view.width + x];
}

float depth_step(float backward, float here, float forward, bool relative) {
  const float db = here - backward, df = forward - here;
  const bool ahead = abs(df) <= abs(db);
  const float change = ahead ? df : db;
  const float scale = relative ? (ahead ? forward : backward) : 1.0;
  return abs(change) < kInf ? change / scale : 0.0;
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
  vec3 n = vec3(du * view.scale_y, -dv * view.scale_x, view.scale_x * view.scale_y);
  if (relative) n.z += a * n.x + b * n.y;
  if (kGiven) {
    const vec3 given = texelFetch(normal_image, ivec2(x, y), 0).xyz;
    const float square = dot(given, given);
    if (square > 0.0 && square < kInf) n = given;
  }
  const float largest = max(abs(n.x), max(abs(n.y), abs(n.z)));
  const bool surface = d < kInf && largest > 0.0 && largest < kInf;
  n *= 1.0 / largest;
  n = surface ? n / sqrt(dot(n, n)) : vec3(0.0, 0.0, 1.0);
  normals[p.y * view.visible_width + p.x] = vec4(n, 0.0);
}
