// Horizons along a few directions, horizon_simd.cpp in GLSL; symbols as there. One pixel per
// invocation, one sum of an interleaved pattern each (filters/interleaved).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "screen/horizon/horizon_io.h"
#include "gpu/view.glsl"

float rho_table(int i) { return tables[3 * (kDirections + kInterleave * kInterleave) + i]; }

#include "math/falloff.glsl"
#include "math/slab.glsl"

const float kEdgeOnNormal = 1e-3;

struct Receiver {
  float z, distance;
  vec2 at, ray;
  float ray_length;
  vec3 t1, t2;  // tangents (u, v, w)
  vec3 n;       // the normal
  float nz, inverse_nz, nr;
};

Receiver make_receiver(ivec2 at, float z, vec3 normal) {
  const float perspective = view.orthographic != 0 ? 0.0 : 1.0;
  Receiver r;
  r.z = z;
  r.distance = view.orthographic != 0 ? 1.0 : z;
  r.at = vec2(at);
  r.ray = perspective * (r.at - (vec2(view.center_u, view.center_v) - 0.5)) *
          vec2(view.scale_x, view.scale_y);
  const float across = sqrt(r.ray.x * r.ray.x + 1.0);
  r.ray_length = sqrt(dot(r.ray, r.ray) + 1.0);
  const float inverse = 1.0 / across;
  r.t1 = vec3(inverse, 0.0, -r.ray.x * inverse);
  const float scale = inverse / r.ray_length;
  r.t2 = vec3(-r.ray.x * r.ray.y * scale, across / r.ray_length, -r.ray.y * scale);
  const vec3 n = vec3(normal.x, -normal.y, -normal.z), ray = vec3(r.ray, 1.0);
  r.nz = -dot(n, ray) / r.ray_length;
  r.n = n - max(kEdgeOnNormal - r.nz, 0.0) / r.ray_length * ray;
  r.nz = max(r.nz, kEdgeOnNormal);
  r.inverse_nz = 1.0 / r.nz;
  r.nr = -r.nz * r.ray_length;
  return r;
}

struct Line {
  vec3 t;
  float nt;
  vec2 step;
  float last;
};

float border(float at, float step, int size) {
  return (step > 0.0 ? float(size - 1) - at : at) / max(abs(step), 1e-6);
}

Line make_line(Receiver r, vec2 turn) {
  Line line;
  line.t = turn.x * r.t1 + turn.y * r.t2;
  line.nt = dot(r.n, line.t);
  const vec2 g = (line.t.xy - r.ray * line.t.z) / vec2(view.scale_x, view.scale_y);
  const float pixels = sqrt(dot(g, g));
  line.step = g / pixels;
  line.last = min(view.radius * pixels / r.distance,
                  min(border(r.at.x, line.step.x, view.width),
                      border(r.at.y, line.step.y, view.height)));
  return line;
}

struct Point {
  vec2 p;
  bool valid;
};

// Sample j along a line.
Point point_at(Receiver r, Line line, float shift, int j) {
  float share = (shift + float(j)) * (1.0 / float(kSteps));
  if (!kClassic) share *= share;
  const float pixels = min(max(share * line.last, float(j + 1)), line.last);
  const vec2 size = vec2(view.width, view.height);
  const vec2 texel = clamp(r.at + roundEven(pixels * line.step), vec2(0.0), size - 1.0);
  const vec2 k = (texel - r.at) * vec2(view.scale_x, view.scale_y);
  const float q = depth[int(texel.y) * view.width + int(texel.x)];
  Point point;
  point.valid = q < kInf;
  const float z = point.valid ? q : r.z;
  const float away = view.orthographic != 0 ? r.distance : z;
  point.p.x = away * dot(k, line.t.xy);
  const float height = away * dot(k, r.n.xy) + (z - r.z) * r.nr;
  point.p.y = (height - line.nt * point.p.x) * r.inverse_nz;
  point.valid = point.valid && point.p.x > 0.0;
  return point;
}

// rho = 1 up to R: cosine of the zenith angle down to which the matter below a sample reaches.
float cut_cosine(Slice s, vec2 p) {
  const float square = dot(p, p);
  if (square <= view.rho_radius * view.rho_radius) return p.y * inversesqrt(max(square, 1e-37));
  vec2 e = p * s.perspective - vec2(0.0, s.camera);
  if (!(dot(p, e) < 0.0)) return -2.0;
  e *= inversesqrt(max(dot(e, e), 1e-37));
  const float distance = abs(cross_product(p, e)) * view.inverse_radius;
  const float rest = 1.0 - distance * distance;
  return rest > 0.0 ? distance * e.x - sqrt(rest) * e.y : -2.0;
}

// What a direction has lost: the visible share, solid angle, and directions along tangent and
// zenith.
struct Lost {
  float visibility, solid;
  vec2 directions;
};

Lost constant_slice(Receiver r, Line line, Slice s, float shift) {
  float cosine = s.edge_cosine;
  for (int j = 0; j < kSteps; ++j) {
    const Point point = point_at(r, line, shift, j);
    if (point.valid) cosine = max(cosine, cut_cosine(s, point.p));
  }
  cosine = min(cosine, 1.0);
  const float sine = sqrt(1.0 - cosine * cosine), angle = fast_acos(cosine);
  Lost lost;
  lost.visibility = s.edge_integral - cosine_integral(s.nz, s.nt, sine, cosine, angle);
  lost.directions = direction_integral(s, s.edge_sine, s.edge_cosine, s.edge_angle) -
                    direction_integral(s, sine, cosine, angle);
  lost.solid = cosine - s.edge_cosine;
  return lost;
}

Lost falling_slice(Receiver r, Line line, Slice s, float shift) {
  Horizon h = start_horizon(s, true);
  for (int j = 0; j < kSteps; ++j) {
    const Point point = point_at(r, line, shift, j);
    add_point(s, point.p, point.valid, h);
  }
  return Lost(h.sum, h.sum_solid, h.sum_directions);
}

Lost classic_slice(Receiver r, Line line, float shift) {
  const float scale = inversesqrt(r.nz * r.nz + line.nt * line.nt);
  const float start =
      -line.nt * scale * view.bias_cosine + r.nz * scale * view.bias_sine;
  float horizon = start, obscured = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    const Point point = point_at(r, line, shift, j);
    const float square = max(dot(point.p, point.p), 1e-37);
    const float sine = point.p.y * inversesqrt(square);
    const float weight = 1.0 - square / (view.radius * view.radius);
    if (point.valid && weight > 0.0 && sine > horizon) {
      obscured += weight * (sine - horizon);
      horizon = sine;
    }
  }
  const float mean = 0.5 * (start + horizon), extent = horizon - start;
  const float rest = max(1.0 - extent * extent / 12.0 - mean * mean, 0.0);
  return Lost(obscured, obscured, obscured * vec2(sqrt(rest), mean));
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const ivec2 at = p + ivec2(view.left, view.top);
  const int i = p.y * view.visible_width + p.x;
  const float z = depth[at.y * view.width + at.x];
  const vec3 n = normals[i].xyz;
  const Receiver r = make_receiver(at, z < kInf ? z : 1.0, n);
  const float perspective = view.orthographic != 0 ? 0.0 : 1.0;
  const float camera = view.orthographic != 0 ? 1.0 : r.z * r.ray_length;
  const ivec2 place = pattern_place(p) % kInterleave;
  const int tile = 3 * (kDirections + place.y * kInterleave + place.x);
  const vec2 tile_turn = vec2(tables[tile], tables[tile + 1]);
  float visibility = 0.0, solid = 0.0, zenith = 0.0;
  vec2 tangents = vec2(0.0);
  for (int k = 0; z < kInf && k < kDirections; ++k) {
    const vec2 d = vec2(tables[3 * k], tables[3 * k + 1]);
    const vec2 turn = vec2(d.x * tile_turn.x - d.y * tile_turn.y,
                           d.y * tile_turn.x + d.x * tile_turn.y);
    const float shift = fract(tables[tile + 2] + tables[3 * k + 2]);
    const Line line = make_line(r, turn);
    Lost lost;
    if (kClassic) {
      lost = classic_slice(r, line, shift);
    } else {
      const Slice s = make_slice(r.nz, line.nt, camera, perspective);
      if (kFalloff == kConstantRho) {
        lost = constant_slice(r, line, s, shift);
      } else {
        lost = falling_slice(r, line, s, shift);
      }
    }
    visibility += lost.visibility;
    solid += lost.solid;
    tangents += lost.directions.x * turn;
    zenith += lost.directions.y;
  }
  const float each = 1.0 / float(kDirections);
  const float open = 1.0 - visibility * (kClassic ? each : 2.0 * each);
  if (kSums == kSumVisibility) {
    open_sums[i] = open;
    return;
  }
  const vec3 lost = tangents.x * r.t1 + tangents.y * r.t2 - zenith / r.ray_length * vec3(r.ray, 1.0);
  sums[i] = vec4(0.5 * each * solid * n + each * vec3(-lost.x, lost.y, lost.z), open);
}
