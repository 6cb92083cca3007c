// Line sampling of volumetric obscurance, as line_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/sphere_line_leaf.h"
#include "screen/volumetric/line/line_leaf.h"
#include "view/taps_leaf.h"
#include "screen/volumetric/line/line_io.h"
#include "gpu/view.glsl"
#include "view/taps.glsl"
#include "gpu/visibility_target.glsl"

const float kMaxThickness = 1e30;

// Integral of rho from the sphere's middle to z.
float rho_integral(float z, float lateral) { return kQuadratic ? quadratic_line(z, lateral) : z; }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  if (!(z < kInf)) {
    store_visibility(p, 1.0);
    return;
  }
  Receiver r = receiver_at(p, z);
  const float per_unit = kQuadratic ? 1.0 / (kTangent ? 0.5 * view.radius : view.radius) : 1.0;
  // The sphere's centre.
  vec2 center = vec2(0.0);
  float nearer = 0.0, center_z = z;
  if (kNormals) {
    set_normal(r, normals[p.y * view.visible_width + p.x].xyz);
    if (kTangent) {
      center = 0.5 * r.reach * vec2(r.normal.x, -r.normal.y);
      const float lift = 0.5 * view.radius * r.normal.z;
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
    vec2 offset_px = r.reach * s + center;
    if (kRotate) {
      offset_px = vec2(fma(r.reach.x * noise.x, s.x, fma(r.reach.x * noise.y, s.y, center.x)),
                       fma(r.reach.y * noise.y, s.x, fma(-r.reach.y * noise.x, s.y, center.y)));
    }
    const ivec2 texel = find_texel(r, offset_px);
    const vec2 k = vec2(texel - r.at);
    float zu = zs;
    if (kNormals) {
      const vec2 plane = plane_at(r, k);
      zu = plane_bound(r.distance * per_unit * plane.x, plane.y, nearer, zs);
    }
    const float offset = (depth[texel.y * view.width + texel.x] - center_z) * per_unit;
    float line = rho_integral(max(min(offset, zu), -zs), lateral);
    if (kThickness) {
      const float back = offset + min(thickness_at(r, k) * per_unit, kMaxThickness);
      line += rho_integral(zu, lateral) - rho_integral(max(min(back, zu), -zs), lateral);
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
