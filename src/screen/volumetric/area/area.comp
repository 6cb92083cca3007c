// Area sampling of volumetric obscurance, as area_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/sphere_line_leaf.h"
#include "screen/volumetric/area/area_leaf.h"
#include "view/taps_leaf.h"
#include "screen/volumetric/area/area_io.h"
#include "gpu/view.glsl"
#include "screen/volumetric/area/moments.glsl"
#include "view/taps.glsl"
#include "gpu/visibility_target.glsl"

float rho_integral(float z, float lateral) { return kQuadratic ? quadratic_line(z, lateral) : z; }

// Loos and Sloan 2010, section 4.2: visibility is 1 up to mu - sigma and falls to 0 at mu + sigma.
// Integral of rho times visibility over [-zs, zs].
float integral(float mu, float sigma, float zs, float half_line, float lateral) {
  const float end = mu + sigma;
  const float lo = clamp(mu - sigma, -zs, zs), hi = clamp(end, -zs, zs);
  const float rho_lo = rho_integral(lo, lateral), rho_hi = rho_integral(hi, lateral);
  const float ramp = kQuadratic ? quadratic_ramp(lo, hi, end, rho_lo, rho_hi, lateral)
                                : constant_ramp(lo, hi, end);
  return ramp / (2.0 * sigma) + (rho_lo + half_line);
}

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

Place place_at(Receiver r, ivec2 pixel, float sample_level, vec2 jitter) {
  // Near the border the level sinks until the next one's kernel fits into the image.
  const ivec2 room = min(pixel, ivec2(view.width, view.height) - 1 - pixel);
  const float least = float(min(room.x, room.y) + 2);
  const float fits = float(floatBitsToInt(least)) * (1.0 / 8388608.0) - 129.5;
  const vec2 reach = max(r.reach, vec2(1e-3));
  const float wanted = 0.5 * log2(reach.x * reach.y) - 0.5 + sample_level;
  const float level = max(min(wanted, min(fits, float(view.level_count) - 1.5)), -0.5);
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

// Share, mean and deviation, interpolated between levels; where the level sees background only, the
// next one's mean and deviation stand in.
vec3 look_up(Place s) {
  vec3 now = moments_at(s.level, s.level, s.texel), next = now;
  if (s.level + 1 < view.level_count) next = moments_at(s.level + 1, s.level, s.texel);
  if (!(now.y > 0.0)) now.yz = next.yz;
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
  Receiver r = receiver_at(p, z);
  if (kNormals) set_normal(r, normals[p.y * view.visible_width + p.x].xyz);
  const float per_radius = 1.0 / view.radius, gradient = length(r.plane);
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
    const ivec2 pixel = find_texel(r, r.reach * offset);
    const Place place = place_at(r, pixel, tables[t + 6], jitter);
    const vec3 m = look_up(place);
    const float mu = clamp((m.y - z) * per_radius, -kMaxOffset, kMaxOffset);
    const float sigma = clamp(m.z * per_radius, kLeastDeviation, kMaxOffset);

    float bound = 2.0 * half_line, line = integral(mu, sigma, zs, half_line, lateral);
    if (kNormals) {
      const vec2 q = plane_at(r, vec2(place.pixel - r.at));
      const PlaneMoments plane = plane_moments(
          q.x, q.y, gradient, r.distance, r.perspective, kernel_width(place.level),
          kernel_width(place.level + 1), place.blend, per_radius);
      bound = integral(plane.mean, max(plane.deviation, kLeastDeviation), zs, half_line, lateral);
      line = min(line, bound);
    }
    if (kThickness) {
      const float behind = min(thickness_at(r, vec2(pixel - r.at)) * per_radius, kMaxOffset);
      const float back = min(mu + behind, kMaxOffset);
      line += bound - min(integral(back, sigma, zs, half_line, lateral), bound);
    }
    // Background occludes nothing.
    line = mix(bound, line, m.x);
    open += tables[t + 5] * line;
    whole += tables[t + 5] * bound;
  }
  if (kNormals) open = whole > 0.0 ? open / whole : 1.0;
  store_visibility(p, open);
}
