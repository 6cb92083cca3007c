// Point sampling of volumetric obscurance in the ball, as point_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "view/taps_leaf.h"
#include "screen/volumetric/point/point_io.h"
#include "gpu/view.glsl"
#include "view/taps.glsl"
#include "gpu/visibility_target.glsl"

// Whether a surface at this depth offset lies in front of the sample.
bool in_front(float at, float slope, float level) { return (at * slope - level) * slope < 0.0; }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  if (!(z < kInf)) {
    store_visibility(p, 1.0);
    return;
  }
  Receiver r = receiver_at(p, z);
  if (kNormals) set_normal(r, normals[p.y * view.visible_width + p.x].xyz);
  vec3 noise = vec3(0.0);
  if (kRotate) {
    const ivec2 place = pattern_place(p) % kNoise;
    const int k = 3 * (place.y * kNoise + place.x);
    noise = vec3(tables[k], tables[k + 1], tables[k + 2]);
  }
  float occupied = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const int t = view.pattern + 4 * i;
    vec3 s = vec3(tables[t], tables[t + 1], tables[t + 2]);
    if (kRotate) s -= 2.0 * dot(s, noise) * noise;
    float height = 0.0;
    if (kNormals) {
      height = dot(s, r.normal);
      s -= 2.0 * min(height, 0.0) * r.normal;
      height = abs(height);
    }
    const ivec2 texel = find_texel(r, r.reach * vec2(s.x, -s.y));
    const vec2 k = vec2(texel - r.at);
    float slope = -1.0, level = s.z * view.radius;
    if (kNormals) {
      const vec2 plane = plane_at(r, k);
      slope = plane.y;
      level = height * view.radius + r.distance * plane.x + kDepthGrain * z;
    }
    const float offset = depth[texel.y * view.width + texel.x] - z;
    bool inside = in_front(offset, slope, level);
    if (kThickness) inside = inside && !in_front(offset + thickness_at(r, k), slope, level);
    if (inside) occupied += tables[t + 3];
  }
  store_visibility(p, 1.0 - occupied);
}
