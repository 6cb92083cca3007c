// Point samples on the screen, as screen_pattern_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "view/taps_leaf.h"
#include "screen/volumetric/point/screen_pattern_io.h"
#include "gpu/view.glsl"
#include "view/taps.glsl"

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  if (!(z < kInf)) return;
  const int at = p.y * view.visible_width + p.x;
  Receiver r = receiver_at(p, z);
  vec3 n = vec3(0.0, 0.0, 1.0);
  if (kNormals) {
    n = normals[at].xyz;
    set_normal(r, n);
  }
  vec2 noise = vec2(1.0, 0.0);
  if (kRotate) {
    const ivec2 place = pattern_place(p) % kNoise;
    const int k = 2 * (place.y * kNoise + place.x);
    noise = vec2(tables[k], tables[k + 1]);
  }
  const vec2 scale = vec2(view.scale_x, -view.scale_y);
  float occupied = 0.0;
  vec3 lost = vec3(0.0);
  for (int i = 0; i < kSamples; ++i) {
    const int t = view.pattern + 3 * i;
    const vec2 s = vec2(tables[t], tables[t + 1]);
    // y of the pattern is up, that of pixels down.
    const ivec2 texel = find_texel(r, r.reach * vec2(noise.x * s.x + noise.y * s.y,
                                                     noise.x * s.y - noise.y * s.x));
    const vec2 k = vec2(texel - r.at);
    // The background is far enough not to lie in any sphere.
    const float there = depth[texel.y * view.width + texel.x];
    const float offset = (there < kInf ? there : 1e18) - z;
    // From the receiver to the surface point, P' - P = t r' - z r.
    const vec3 v = vec3(offset * ray_at(r, k) + r.distance * k * scale, -offset);
    const float square = max(dot(v, v), 1e-37), inverse = inversesqrt(square);
    const float length = square * inverse / view.radius;
    float height = -offset;
    if (kNormals) {
      const vec2 plane = plane_at(r, k);
      height = offset * plane.y - r.distance * plane.x;
    }
    const float near = 1.0 - length, rho = kQuadratic ? near * near : 1.0;
    const float bias = view.angle_grain * view.radius * length + kDepthGrain * z;
    if (near >= 0.0 && height > bias) {
      const float share = rho * tables[t + 2];
      occupied += share;
      lost += share * inverse * v;
    }
  }
  // mean V w - open n/2 = n/2 - lost - (1 - occupied) n/2
  if (kDirections) {
    sums[at] = vec4(0.5 * occupied * n - lost, 1.0 - occupied);
  } else {
    open_sums[at] = 1.0 - occupied;
  }
}
