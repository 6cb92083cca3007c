// Directions over the hemisphere, each tested at a few points in depth: hemisphere_simd.cpp in GLSL;
// symbols as there. One pixel per invocation, one sum of an interleaved pattern each
// (filters/interleaved).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/hemisphere/hemisphere_io.h"
#include "gpu/view.glsl"

const int kTileCos = 0, kTileSin = 1, kTileShift = 2, kTileOffset = 3, kTileMean = 4;
const int kTileCosineSum = 10, kTileValues = 11;

struct Receiver {
  vec3 p;  // eye space; z is depth
  vec3 n, t, b;
  float plane, slack;
};

Receiver make_receiver(ivec2 at, float z, vec3 n) {
  Receiver r;
  const vec2 ray = vec2((float(at.x) + (0.5 - view.center_u)) * view.scale_x,
                        (view.center_v - (float(at.y) + 0.5)) * view.scale_y);
  r.p = vec3(ray * (view.orthographic != 0 ? 1.0 : z), z);
  r.n = n;
  const float side = n.z < 0.0 ? -1.0 : 1.0;
  const float k = -1.0 / (side + n.z), xy = n.x * n.y * k;
  r.t = vec3(1.0 + side * n.x * n.x * k, side * xy, -side * n.x);
  r.b = vec3(xy, side + n.y * n.y * k, -n.y);
  r.plane = dot(n, vec3(r.p.xy, -z));
  r.slack = z * 1e-5;
  return r;
}

// Whether the point at distance t along w lies behind what the depth image holds there.
bool behind(Receiver r, vec3 w, float cosine, float t) {
  const float z = r.p.z - t * w.z;
  const float away = view.orthographic != 0 ? 1.0 : 1.0 / z;
  const vec2 at = (r.p.xy + t * w.xy) * away;
  const float u = floor(fma(at.x, 1.0 / view.scale_x, view.center_u));
  const float v = floor(fma(-at.y, 1.0 / view.scale_y, view.center_v));
  if (!(z > 0.0 && u >= 0.0 && u < float(view.width) && v >= 0.0 && v < float(view.height))) {
    return false;
  }
  const float q = depth[int(v) * view.width + int(u)];
  const float a = (u + 0.5 - view.center_u) * view.scale_x;
  const float b = (view.center_v - 0.5 - v) * view.scale_y;
  const float across = r.n.x * a + r.n.y * b;
  const float slope = view.orthographic != 0 ? -r.n.z : across - r.n.z;
  const float point = view.orthographic != 0 ? across - r.n.z * q : q * slope;
  const bool hit = slope < 0.0 ? point > t * cosine + (r.plane + r.slack) : q < z;
  if (!kThickness) return hit;
  const float length = view.orthographic != 0 ? 1.0 : sqrt(a * a + b * b + 1.0);
  return hit && z < q + view.thickness / length;
}

// V of a direction: 1 - rho at the first point that is behind.
float visible(Receiver r, vec3 w, float cosine, float offset) {
  for (int k = 0; k < kTests; ++k) {
    const float share = (float(k) + offset) * (1.0 / float(kTests));
    const float t = share * share * view.radius;
    if (!behind(r, w, cosine, t)) continue;
    const float near = 1.0 - t * (1.0 / view.radius);
    return kQuadratic ? 1.0 - near * near : 0.0;
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
  const Receiver r = make_receiver(at, z, normals[i].xyz);
  const ivec2 place = pattern_place(p) % kInterleave;
  const int tile = 3 * kSamples + kTileValues * (place.y * kInterleave + place.x);
  const vec2 turn = vec2(tables[tile + kTileCos], tables[tile + kTileSin]);
  float open = 0.0, open_cosine = 0.0;
  vec3 sum = vec3(0.0);
  for (int s = 0; s < kSamples; ++s) {
    const float cosine = 1.0 - (float(s) + tables[tile + kTileShift]) * (1.0 / float(kSamples));
    const float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    const vec2 d = vec2(tables[3 * s], tables[3 * s + 1]);
    const vec2 l =
        sine * vec2(d.x * turn.x - d.y * turn.y, d.y * turn.x + d.x * turn.y);
    const vec3 w = l.x * r.t + l.y * r.b + cosine * r.n;
    const float seen =
        visible(r, w, cosine, fract(tables[3 * s + 2] + tables[tile + kTileOffset]));
    open += seen;
    open_cosine += seen * cosine;
    sum += seen * w;
  }
  const float mean = open * (1.0 / float(kSamples));
  if (kOpen) open_sums[i] = kCosine ? open_cosine / tables[tile + kTileCosineSum] : mean;
  if (!kDirections) return;
  const vec3 whole = vec3(tables[tile + kTileMean], tables[tile + kTileMean + 1],
                          tables[tile + kTileMean + 2]);
  sums[i] = vec4(sum * (1.0 / float(kSamples)) -
                     mean * (whole.x * r.t + whole.y * r.b + whole.z * r.n),
                 mean);
}
