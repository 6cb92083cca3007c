// Point sampling of volumetric obscurance in the ball, as point_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "view/receiver_leaf.h"
#include "screen/volumetric/point/point_leaf.h"
#include "screen/volumetric/point/point_io.h"
#include "gpu/view.glsl"
#include "view/receiver.glsl"
#include "gpu/visibility_target.glsl"

bool in_front(float at, float slope, float level) {
  return kNormals ? in_front_by_plane(at, slope, level) : in_front_by_depth(at, level);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  if (!(z < kInf)) {
    store_visibility(p, 1.0);
    return;
  }
  TapReceiver r = receiver_at(p, z);
  const vec2 reach = vec2(r.reach_x, r.reach_y);
  vec3 normal = vec3(0.0);
  if (kNormals) {
    const vec3 n = normals[p.y * view.visible_width + p.x].xyz;
    set_tap_normal(n.x, n.y, n.z, r);
    normal = vec3(r.nx, r.ny, r.nz);
  }
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
      height = dot(s, normal);
      s -= 2.0 * min(height, 0.0) * normal;
      height = abs(height);
    }
    const ivec2 texel = find_texel(p, reach * vec2(s.x, -s.y));
    const vec2 k = vec2(texel - whole_image(p));
    float slope = -1.0, level = s.z * view.radius;
    if (kNormals) {
      const TexelPlane plane = plane_at(r, k.x, k.y);
      slope = plane.slope;
      level = level_above_plane(r, height, view.radius, plane.q);
    }
    const float offset = depth[texel.y * view.width + texel.x] - z;
    bool inside = in_front(offset, slope, level);
    if (kThickness) {
      const float back = offset + thickness_at(r, k.x, k.y, view.thickness);
      inside = inside && !in_front(back, slope, level);
    }
    if (inside) occupied += tables[t + 3];
  }
  store_visibility(p, 1.0 - occupied);
}
