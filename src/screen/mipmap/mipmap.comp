// Slices from the depth pyramid, mipmap_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "math/slice_leaf.h"
#include "math/apart_leaf.h"
#include "screen/mipmap/mipmap_leaf.h"
#include "screen/mipmap/mipmap_io.h"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

const bool kChord = false;
const int kSums = 0;

float rho_table(int i) { return uintBitsToFloat(quads[view.rho_start + i / 4][i % 4]); }

#include "gpu/rho.glsl"
#include "math/horizon_leaf.h"
#include "screen/mipmap/mipmap.glsl"

const float kPi = 3.14159265;

float fetch(int level, ivec2 p) {
  return texel_of(level, clamp(p, ivec2(0), level_size(level) - 1));
}

// Depth of a level at pixel coordinates, 0 where any texel read is background.
float read_level(int level, vec2 at) {
  const vec2 p = at / float(1 << level) - (kInterpolate ? 0.5 : 0.0);
  const ivec2 i = ivec2(floor(p));
  const float a = fetch(level, i);
  if (!kInterpolate) return a;
  const float b = fetch(level, i + ivec2(1, 0)), c = fetch(level, i + ivec2(0, 1));
  const float e = fetch(level, i + 1);
  const vec2 s = p - floor(p);
  return between_depths(a, b, c, e, s.x, s.y);
}

struct Receiver {
  float depth;
  ViewRay ray;
  vec2 at;
  vec3 normal;  // (u, v, w), w away from the camera
};

// Pixels to the image's last texel centres along a direction.
float distance_to_edge(vec2 at, vec2 d) {
  const vec2 last = vec2(view.width, view.height) - 0.5;
  const vec2 far = vec2(d.x > 0.0 ? last.x : 0.5, d.y > 0.0 ? last.y : 0.5);
  return min(abs(d.x) > 1e-6 ? (far.x - at.x) / d.x : 1e9,
             abs(d.y) > 1e-6 ? (far.y - at.y) / d.y : 1e9);
}

void add_samples(Receiver r, Slice slice, vec2 d, Azimuth azimuth, inout Horizon h) {
  const float edge = distance_to_edge(r.at, d);
  const float limit = depth_without_effect(r.depth);
  float before = 0.0;
  for (int k = 0; k < view.step_count; ++k) {
    const uvec4 entry = quads[view.steps + k];
    const float t = min(uintBitsToFloat(entry.x), edge);
    if (!(t > before)) break;
    before = t;
    const vec2 at = r.at + t * d;
    const int level = int(entry.y);
    float q = read_level(level, at);
    if (kInterpolate && level + 1 < view.level_count) {
      q = between_levels(q, read_level(level + 1, at), uintBitsToFloat(entry.z));
    }
    const bool found = q > 0.0 && q < limit;
    if (!found) q = 1.0;
    const PyramidPoint p = pyramid_point(t, q, r.depth, r.ray.ray_length, azimuth.along,
                                         azimuth.across, view.orthographic != 0);
    add_point(slice, p.x, p.y, found, false, 1.0, h);
  }
}

// Obscurance of one direction's sector.
float slice_of(Receiver r, int k) {
  const vec2 scale = vec2(view.scale_x, view.scale_y);
  const vec4 a = uintBitsToFloat(quads[view.directions + 2 * k]);
  const vec2 middle = a.xy * scale, low = a.zw * scale;
  const vec2 high = uintBitsToFloat(quads[view.directions + 2 * k + 1].xy) * scale;
  const Azimuth azimuth =
      make_azimuth(r.ray, middle.x, middle.y, r.normal.x, r.normal.y, r.normal.z);
  const bool parallel = view.orthographic != 0;
  const Slice slice = make_slice(azimuth.nz, azimuth.nt, parallel ? 1.0 : r.depth * r.ray.ray_length,
                                 parallel ? 0.0 : 1.0);
  Horizon h = start_horizon(slice, true);
  add_samples(r, slice, a.xy, azimuth, h);
  return h.sum * azimuth_between(r.ray, low.x, low.y, high.x, high.y);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const ivec2 texel = p + ivec2(view.left, view.top);
  const float d = depth[texel.y * view.width + texel.x];
  const vec3 n = normals[p.y * view.visible_width + p.x].xyz;
  Receiver r;
  r.depth = d;
  r.at = vec2(texel) + 0.5;
  const vec2 ray = view.orthographic != 0 ? vec2(0.0)
                                          : (r.at - vec2(view.center_u, view.center_v)) *
                                                vec2(view.scale_x, view.scale_y);
  r.ray = make_ray(ray.x, ray.y);
  r.normal = vec3(n.x, -n.y, -n.z);
  float sum = 0.0;
  for (int k = 0; d < kInf && k < kDirections; ++k) sum += slice_of(r, k);
  write_visibility(p, clamp(1.0 - sum / kPi, 0.0, 1.0));
}
