// Directions over the hemisphere, each tested at a few points in depth: hemisphere_simd.cpp in GLSL;
// symbols as there. One pixel per invocation, one sum of an interleaved pattern each
// (filters/interleaved).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "screen/hemisphere/hemisphere_leaf.h"
#include "screen/hemisphere/tile_leaf.h"
#include "screen/hemisphere/hemisphere_io.h"
#include "gpu/view.glsl"

HemisphereReceiver receiver_at(ivec2 at, float z, vec3 n) {
  return hemisphere_receiver((float(at.x) + (0.5 - view.center_u)) * view.scale_x,
                       (view.center_v - (float(at.y) + 0.5)) * view.scale_y, z,
                       vector_of(n.x, n.y, n.z), view.orthographic != 0);
}

// Whether the point at distance t along w lies behind what the depth image holds there.
bool behind(HemisphereReceiver r, EyeDirection w, float cosine, float t) {
  const bool parallel = view.orthographic != 0;
  const Seen seen = image_of_point(r, w, t, 1.0 / view.scale_x, 1.0 / view.scale_y, view.center_u,
                            view.center_v, parallel);
  const float u = floor(seen.u), v = floor(seen.v);
  if (!(seen.z > 0.0 && u >= 0.0 && u < float(view.width) && v >= 0.0 && v < float(view.height))) {
    return false;
  }
  const float a = (u + 0.5 - view.center_u) * view.scale_x;
  const float b = (view.center_v - 0.5 - v) * view.scale_y;
  const int at = int(v) * view.width + int(u);
  const float front = depth[at];
  float back = front;
  if (kMatter == kOfThickness) back = back_of_thickness(front, view.thickness, a, b, parallel);
  if (kMatter == kWithBack) back = max(backs[at], front);
  return is_behind(r, cosine, t, seen.z, a, b, front, parallel, kMatter != kSolid, back);
}

// V of a direction: 1 - rho at the first point that is behind.
float visible(HemisphereReceiver r, EyeDirection w, float cosine, float offset) {
  for (int k = 0; k < kTests; ++k) {
    const float t = test_distance(float(k), offset, 1.0 / float(kTests), view.radius);
    if (behind(r, w, cosine, t)) return visible_beyond(t, 1.0 / view.radius, kQuadratic);
  }
  return 1.0;
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const ivec2 at = p + ivec2(view.left, view.top);
  const int i = p.y * view.visible_width + p.x;
  const float z = depth[at.y * view.width + at.x];
  if (!(z < kInf)) return;
  const HemisphereReceiver r = receiver_at(at, z, normals[i].xyz);
  const ivec2 place = pattern_place(p) % kInterleave;
  const int tile = 3 * kSamples + kTileValues * (place.y * kInterleave + place.x);
  const vec2 turn = vec2(tables[tile + kTileCos], tables[tile + kTileSin]);
  float open = 0.0, open_cosine = 0.0;
  vec3 sum = vec3(0.0);
  for (int s = 0; s < kSamples; ++s) {
    const float cosine =
        stratum_cosine(float(s), tables[tile + kTileShift], 1.0 / float(kSamples));
    const float sine = sine_of(cosine);
    const vec2 d = vec2(tables[3 * s], tables[3 * s + 1]);
    const vec2 l =
        sine * vec2(d.x * turn.x - d.y * turn.y, d.y * turn.x + d.x * turn.y);
    const EyeDirection w = in_eye_space(r, l.x, l.y, cosine);
    const float seen =
        visible(r, w, cosine, fract(tables[3 * s + 2] + tables[tile + kTileOffset]));
    open += seen;
    open_cosine += seen * cosine;
    sum += seen * vec3(w.x, w.y, w.z);
  }
  const float mean = open * (1.0 / float(kSamples));
  if (kOpen) open_sums[i] = kCosine ? open_cosine / tables[tile + kTileCosineSum] : mean;
  if (!kDirections) return;
  const EyeDirection whole = in_eye_space(r, tables[tile + kTileMean], tables[tile + kTileMean + 1],
                                    tables[tile + kTileMean + 2]);
  sums[i] = vec4(sum * (1.0 / float(kSamples)) - mean * vec3(whole.x, whole.y, whole.z), mean);
}
