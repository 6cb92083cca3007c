// Line sampling of volumetric obscurance, as line_simd.cpp; symbols as there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "math/sphere_line_leaf.h"
#include "screen/volumetric/line/line_leaf.h"
#include "view/taps_leaf.h"
#include "view/receiver_leaf.h"
#include "screen/volumetric/line/line_io.h"
#include "gpu/view.glsl"
#include "view/receiver.glsl"
#include "gpu/visibility_target.glsl"

// Integral of rho from the sphere's middle to z.
float rho_integral(float z, float lateral) { return kQuadratic ? quadratic_line(z, lateral) : z; }
#include "screen/volumetric/line/open_line_leaf.h"

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
  if (!(z < kInf)) {
    store_visibility(p, 1.0);
    return;
  }
  TapReceiver r = receiver_at(p, z);
  const vec2 reach = vec2(r.reach_x, r.reach_y);
  const float per_unit = kQuadratic ? 1.0 / (kTangent ? 0.5 * view.radius : view.radius) : 1.0;
  // The sphere's centre.
  vec2 center = vec2(0.0);
  float nearer = 0.0, center_z = z;
  if (kNormals) {
    const vec3 n = normals[p.y * view.visible_width + p.x].xyz;
    set_tap_normal(n.x, n.y, n.z, r);
    if (kTangent) {
      center = 0.5 * reach * vec2(r.nx, -r.ny);
      const float lift = 0.5 * view.radius * r.nz;
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
    const ivec2 texel = find_texel(p, offset_px);
    const vec2 k = vec2(texel - whole_image(p));
    float zu = zs;
    if (kNormals) {
      const TexelPlane plane = plane_at(r, k.x, k.y);
      zu = plane_bound(r.distance * per_unit * plane.q, plane.slope, nearer, zs);
    }
    const float offset = (depth[texel.y * view.width + texel.x] - center_z) * per_unit;
    float behind = 0.0;
    if (kThickness) {
      behind = min(thickness_at(r, k.x, k.y, view.thickness) * per_unit, kMaxThickness);
    }
    const float line = open_line(offset, behind, zu, zs, lateral);
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
