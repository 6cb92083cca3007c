// Results at every second pixel of every second row become results everywhere: the pixels between are
// filled in along surfaces, kernel_simd.cpp in GLSL, first along the seen rows and then between them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "filters/edge_leaf.h"
#include "filters/upsampling/upsampling_leaf.h"
#include "filters/upsampling/upsampling_io.h"
#include "gpu/direction_result.glsl"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

struct Value {
  float visibility;
  vec4 direction;  // the difference to the normal, and the cone
};

// Linear on planes; 0: background or outside.
float surface_at(ivec2 p) {
  if (p.x < 0 || p.y < 0 || p.x >= view.visible_width || p.y >= view.visible_height) return 0.0;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  return z < kInf ? (view.orthographic != 0 ? z : 1.0 / z) : 0.0;
}

vec3 normal_at(ivec2 p) { return normals[p.y * view.visible_width + p.x].xyz; }

float alike(ivec2 p, ivec2 q) {
  return likeness(dot(normal_at(p), normal_at(q)));
}

// What the neighbours before and after weigh; both 0: there are none.
vec2 weights(ivec2 p, ivec2 step, float pixel) {
  const float s = surface_at(p), before = surface_at(p - step), after = surface_at(p + step);
  if (!(before > 0.0)) return vec2(0.0, after > 0.0 ? 1.0 : 0.0);
  if (!(after > 0.0)) return vec2(1.0, 0.0);
  const SideWeights sides =
      side_weights(s, before, after, true, true, view.edge * pixel, view.orthographic != 0);
  vec2 w = vec2(sides.before, sides.after);
  if (kNormals) w *= vec2(alike(p, p - step), alike(p, p + step));
  return w;
}

Value blend(vec2 w, Value before, Value after) {
  if (!(w.y > 0.0)) return before;
  if (!(w.x > 0.0)) return after;
  const float share = w.y / (w.x + w.y);
  return Value(mix(before.visibility, after.visibility, share),
               mix(before.direction, after.direction, share));
}

const Value kOpen = Value(1.0, vec4(0.0, 0.0, 0.0, 1.0));

Value seen_at(ivec2 p) {
  const int i = p.y / 2 * ((view.visible_width + 1) / 2) + p.x / 2;
  Value v = Value(seen[i], vec4(0.0));
  if (kDirections) v.direction = seen_directions[i] - vec4(normal_at(p), 0.0);
  return v;
}

// In a row that the method has seen.
Value row_value(ivec2 p) {
  if (p.x % 2 == 0) return seen_at(p);
  const vec2 w = weights(p, ivec2(1, 0), view.scale_x);
  if (w.x + w.y == 0.0) return kOpen;
  Value before = kOpen, after = kOpen;
  if (w.x > 0.0) before = seen_at(p - ivec2(1, 0));
  if (w.y > 0.0) after = seen_at(p + ivec2(1, 0));
  return blend(w, before, after);
}

Value value_at(ivec2 p) {
  if (p.y % 2 == 0) return row_value(p);
  const vec2 w = weights(p, ivec2(0, 1), view.scale_y);
  if (w.x + w.y == 0.0) return kOpen;
  Value before = kOpen, after = kOpen;
  if (w.x > 0.0) before = row_value(p - ivec2(0, 1));
  if (w.y > 0.0) after = row_value(p + ivec2(0, 1));
  return blend(w, before, after);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const bool background = !(surface_at(p) > 0.0);
  Value v = kOpen;
  if (!background) v = value_at(p);
  write_visibility(p, v.visibility);
  if (!kDirections) return;
  vec3 direction = background ? vec3(0.0, 0.0, 1.0) : v.direction.xyz + normal_at(p);
  direction *= inversesqrt(max(dot(direction, direction), 1e-30));
  write_direction(p, vec4(kUnsigned ? 0.5 * direction + 0.5 : direction, v.direction.w));
}
