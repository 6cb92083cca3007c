// Point samples on the screen, as screen_pattern_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "view/receiver_leaf.h"
#include "screen/volumetric/point/screen_pattern_leaf.h"
#include "screen/volumetric/point/screen_pattern_io.h"
#include "gpu/view.glsl"
#include "view/receiver.glsl"

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
