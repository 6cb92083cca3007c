// Line sampling of volumetric obscurance, as line_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/sphere_line_leaf.h"
#define PASS_CONSTANTS int pattern;  // where it starts in the tables
#include "vulkan/view.glsl"
#include "vulkan/visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const int kSamples = 9;
layout(constant_id = 3) const bool kNormals = true;
layout(constant_id = 4) const bool kRotate = true;
layout(constant_id = 5) const bool kThickness = false;
layout(constant_id = 6) const bool kQuadratic = false;
layout(constant_id = 7) const bool kTangent = false;
layout(constant_id = 8) const int kNoise = 64;

layout(binding = 2) readonly buffer Depth { float depth[]; };
layout(binding = 3) readonly buffer Normals { vec4 normals[]; };
// Per pixel of the tile of reflections x, y; per sample of the pattern x, y, lateral, extent, half,
// weight.
layout(binding = 4) readonly buffer Tables { float tables[]; };

const float kMaxReach = 131072.0;
const float kEdgeOn = -1e-4;
const float kMaxThickness = 1e30;

// Integral of rho from the sphere's middle to z.
float rho_integral(float z, float lateral) { return kQuadratic ? quadratic_line(z, lateral) : z; }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const ivec2 at = p + ivec2(view.left, view.top);
  const float z = depth[at.y * view.width + at.x];
  if (!(z < kInf)) {
    store_visibility(p, 1.0);
    return;
  }
  const float perspective = view.orthographic != 0 ? 0.0 : 1.0;
  const float distance = view.orthographic != 0 ? 1.0 : z;
  const vec2 scale = vec2(view.scale_x, view.scale_y);
  const vec2 reach = min(view.radius / scale / distance, vec2(kMaxReach));
  const float per_unit = kQuadratic ? 1.0 / (kTangent ? 0.5 * view.radius : view.radius) : 1.0;
  const float a = perspective * view.scale_x * (float(at.x) - (view.center_u - 0.5));
  const float b = perspective * (view.center_v - (float(at.y) + 0.5)) * view.scale_y;

  vec2 center = vec2(0.0);
  float nearer = 0.0, center_z = z, facing = 0.0;
  vec2 plane = vec2(0.0);
  if (kNormals) {
    vec3 n = normals[p.y * view.visible_width + p.x].xyz;
    facing = n.x * a + n.y * b - n.z;
    const float bend = max(facing - kEdgeOn, 0.0) / (a * a + b * b + 1.0);
    n += bend * vec3(-a, -b, 1.0);
    facing = min(facing, kEdgeOn);
    plane = n.xy * scale;
    if (kTangent) {
      center = 0.5 * reach * vec2(n.x, -n.y);
      const float lift = 0.5 * view.radius * n.z;
      center_z = z - lift;
      nearer = lift * per_unit;
    }
  }
  vec2 noise = vec2(0.0);
  if (kRotate) {
    const ivec2 place = pattern_place(p) % kNoise;
    const int k = 2 * (place.y * kNoise + place.x);
    noise = vec2(tables[k], tables[k + 1]);
  }

  float open = kNormals ? 0.0 : 0.5, whole = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const int t = view.pattern + 6 * i;
    const vec2 s = vec2(tables[t], tables[t + 1]);
    const float lateral = tables[t + 2], zs = tables[t + 3];
    const float half_line = tables[t + 4], weight = tables[t + 5];
    vec2 offset_px = reach * s + center;
    if (kRotate) {
      offset_px = vec2(fma(reach.x * noise.x, s.x, fma(reach.x * noise.y, s.y, center.x)),
                       fma(reach.y * noise.y, s.x, fma(-reach.y * noise.x, s.y, center.y)));
    }
    const ivec2 texel =
        clamp(at + ivec2(roundEven(offset_px)), ivec2(0), ivec2(view.width, view.height) - 1);
    const vec2 k = vec2(texel - at);
    float zu = zs;
    if (kNormals) {
      const float q = plane.y * k.y - plane.x * k.x;
      const float slope = facing - perspective * q;
      if (slope < 0.0) zu = max(min(distance * per_unit * q / slope + nearer, zs), -zs);
    }
    const float offset = (depth[texel.y * view.width + texel.x] - center_z) * per_unit;
    float line = rho_integral(max(min(offset, zu), -zs), lateral);
    if (kThickness) {
      const float ta = a + k.x * perspective * view.scale_x;
      const float tb = b - k.y * perspective * view.scale_y;
      const float behind =
          min(view.thickness / sqrt(ta * ta + tb * tb + 1.0) * per_unit, kMaxThickness);
      line += rho_integral(zu, lateral) - rho_integral(max(min(offset + behind, zu), -zs), lateral);
    }
    if (kNormals) {
      open += weight * (line + half_line);
      whole += weight * (rho_integral(zu, lateral) + half_line);
    } else {
      open += weight * line;
    }
  }
  if (kNormals) open = whole > 0.0 ? open / whole : 1.0;
  store_visibility(p, open);
}
