// Point samples on the screen, as screen_pattern_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "view/receiver_leaf.h"
#include "screen/volumetric/point/screen_pattern_leaf.h"
// Where the samples start in the tables.
#define PASS_CONSTANTS int pattern; float angle_grain;
#include "gpu/view.glsl"
#include "view/receiver.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kSamples = 12;
layout(constant_id = 1) const bool kNormals = true;
layout(constant_id = 2) const bool kRotate = true;
layout(constant_id = 3) const bool kQuadratic = false;
layout(constant_id = 4) const bool kDirections = false;
layout(constant_id = 5) const int kNoise = 64;

layout(binding = 0) readonly buffer Depth { float depth[]; };
layout(binding = 1) readonly buffer Normals { vec4 normals[]; };
// Per pixel of the tile of reflections x, y; per sample x, y, weight.
layout(binding = 2) readonly buffer Tables { float tables[]; };
layout(binding = 3) writeonly buffer Open { float open_sums[]; };
layout(binding = 4) writeonly buffer Directions { vec4 sums[]; };

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  if (!(z < kInf)) return;
  const int at = p.y * view.visible_width + p.x;
  TapReceiver r = receiver_at(p, z);
  const vec2 reach = vec2(r.reach_x, r.reach_y);
  vec3 n = vec3(0.0, 0.0, 1.0);
  if (kNormals) {
    n = normals[at].xyz;
    set_tap_normal(n.x, n.y, n.z, r);
  }
  vec2 noise = vec2(1.0, 0.0);
  if (kRotate) {
    const ivec2 place = pattern_place(p) % kNoise;
    const int k = 2 * (place.y * kNoise + place.x);
    noise = vec2(tables[k], tables[k + 1]);
  }
  float occupied = 0.0;
  vec3 lost = vec3(0.0);
  for (int i = 0; i < kSamples; ++i) {
    const int t = view.pattern + 3 * i;
    const vec2 s = vec2(tables[t], tables[t + 1]);
    // y of the pattern is up, that of pixels down.
    const ivec2 texel = find_texel(p, reach * vec2(noise.x * s.x + noise.y * s.y,
                                                     noise.x * s.y - noise.y * s.x));
    const vec2 k = vec2(texel - whole_image(p));
    // The background is far enough not to lie in any sphere.
    const float there = depth[texel.y * view.width + texel.x];
    const float offset = (there < kInf ? there : 1e18) - z;
    const ScreenPoint point =
        screen_point(r, k.x, k.y, offset, 1.0 / view.radius, view.angle_grain * view.radius,
                     tables[t + 2], kQuadratic, kNormals);
    occupied += point.share;
    lost += point.share * point.inverse * vec3(point.x, point.y, point.z);
  }
  // mean V w - open n/2 = n/2 - lost - (1 - occupied) n/2
  if (kDirections) {
    sums[at] = vec4(0.5 * occupied * n - lost, 1.0 - occupied);
  } else {
    open_sums[at] = 1.0 - occupied;
  }
}
