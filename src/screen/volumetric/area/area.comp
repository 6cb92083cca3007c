// Area sampling of volumetric obscurance, as area_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "math/sphere_line_leaf.h"
#include "math/apart_leaf.h"
#include "screen/volumetric/area/moments_leaf.h"
#include "screen/volumetric/area/area_leaf.h"
#include "view/taps_leaf.h"
#include "view/receiver_leaf.h"
#include "screen/volumetric/area/area_io.h"
#include "gpu/view.glsl"
#include "screen/volumetric/area/moments.glsl"
#include "view/receiver.glsl"
#include "gpu/visibility_target.glsl"

float rho_integral(float z, float lateral) { return kQuadratic ? quadratic_line(z, lateral) : z; }

#include "screen/volumetric/area/sample_leaf.h"

int level_start(int level) { return floatBitsToInt(tables[view.levels + 2 * level]); }
float kernel_width(int level) { return tables[view.levels + 2 * level + 1]; }
int shift_of(int level) { return max(level - (kFullLevels - 1), 0); }
int level_width(int level) { return ((view.width - 1) >> shift_of(level)) + 1; }

// Moments of a level at the texel of level `grid`, its own or the one before.
vec3 moments_at(int level, int grid, ivec2 texel) {
  if (level == 0) {
    const float z = depth[texel.y * view.width + texel.x];
    return z < kInf ? vec3(1.0, z, 0.0) : vec3(0.0);
  }
  const ivec2 at = texel << (shift_of(grid) - shift_of(level - 1));
  return unpack_moments(moments[level_start(level) + at.y * level_width(level - 1) + at.x]);
}

// What a sample sees of the pyramid.
struct Place {
  int level;
  float blend;    // how far the next level counts
  ivec2 texel;    // of the level
  ivec2 pixel;    // at its centre
};

Place place_at(TapReceiver r, ivec2 pixel, float sample_level, float horizon, vec2 jitter) {
  const ivec2 room = min(pixel, ivec2(view.width, view.height) - 1 - pixel);
  const float reach = 0.5 * log2(max(r.reach_x, 1e-3) * max(r.reach_y, 1e-3)) - 0.5;
  const float level = level_of_sample(reach, sample_level, float(min(room.x, room.y)), horizon,
                                      float(view.level_count) - 1.5);
  const float rounded = roundEven(level);
  Place s;
  s.level = int(rounded);
  s.blend = level - rounded + 0.5;
  // With jitter any of the four texels around, each as often as bilinear interpolation would weigh
  // it.
  const int shift = shift_of(s.level), bit = 1 << shift;
  ivec2 at = pixel + (bit >> 1);
  if (kRotate) at += ivec2(roundEven(jitter * float(bit)));
  s.texel = at >> shift;
  s.pixel = s.texel << shift;
  return s;
}

// Share, mean and deviation, interpolated between levels; where the level sees background only, or
// what is background beside the next one's, that one's mean and deviation stand in.
vec3 look_up(Place s) {
  vec3 now = moments_at(s.level, s.level, s.texel), next = now;
  if (s.level + 1 < view.level_count) next = moments_at(s.level + 1, s.level, s.texel);
  if (!stands_beside(now.y, now.y, next.y, view.slack)) now = vec3(0.0, next.yz);
  return mix(now, next, s.blend);
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
  if (kNormals) {
    const vec3 n = normals[p.y * view.visible_width + p.x].xyz;
    set_tap_normal(n.x, n.y, n.z, r);
  }
  const float per_radius = 1.0 / view.radius, gradient = length(vec2(r.plane_x, r.plane_y));
  const vec2 reach = vec2(r.reach_x, r.reach_y);
  const float per_slope = horizon_per_slope(gradient, r.perspective);
  vec2 noise = vec2(0.0);
  if (kRotate) {
    const ivec2 place = pattern_place(p) % kNoise;
    const int k = 2 * (place.y * kNoise + place.x);
    noise = vec2(tables[k], tables[k + 1]);
  }
  // Digits of the random directions that reflection does not notice.
  const vec2 jitter = noise * 64.0 - roundEven(noise * 64.0);

  float open = 0.0, whole = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const int t = view.pattern + 7 * i;
    vec2 offset = vec2(tables[t], tables[t + 1]);
    if (kRotate) {
      offset = vec2(noise.x * offset.x + noise.y * offset.y,
                    noise.y * offset.x - noise.x * offset.y);
    }
    const float lateral = tables[t + 2], zs = tables[t + 3], half_line = tables[t + 4];
    const ivec2 pixel = find_texel(p, reach * offset);
    float horizon = kInf;
    if (kNormals) {
      const vec2 k = vec2(pixel - whole_image(p));
      horizon = plane_at(r, k.x, k.y).slope * per_slope;
    }
    const Place place = place_at(r, pixel, tables[t + 6], horizon, jitter);
    const vec3 m = look_up(place);
    const float mu = bounded_mean((m.y - z) * per_radius);
    const float sigma = bounded_deviation(m.z * per_radius);
    PlaneMoments plane = PlaneMoments(0.0, 0.0);
    if (kNormals) {
      const vec2 k = vec2(place.pixel - whole_image(p));
      const TexelPlane q = plane_at(r, k.x, k.y);
      plane = plane_moments(q.q, q.slope, gradient, r.distance, r.perspective,
                            kernel_width(place.level), kernel_width(place.level + 1), place.blend,
                            per_radius);
    }
    float behind = 0.0;
    if (kThickness) {
      const vec2 k = vec2(pixel - whole_image(p));
      behind = min(thickness_at(r, k.x, k.y, view.thickness) * per_radius, kMaxOffset);
    }
    const SampleLine line = sample_line(mu, sigma, m.x, plane, behind, zs, half_line, lateral);
    open += tables[t + 5] * line.open;
    whole += tables[t + 5] * line.bound;
  }
  if (kNormals) open = whole > 0.0 ? open / whole : 1.0;
  store_visibility(p, open);
}
