// Algorithm 1 in parallel lines, scan_simd.cpp's ScanStrip: per line and strip of rows the nearest
// depth and the greatest slanted height. A group has eight strips of 32 lines and goes on to levels
// 1 to 3 of the pyramid in shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#define PASS_CONSTANTS                                                        \
  int transposed, lattice_stride, margin, directions, line_stride, line_step; \
  float slope;
#include "vulkan/view.glsl"

layout(local_size_x = 32, local_size_y = 8) in;
layout(constant_id = 0) const int kInterval = 10;

layout(binding = 0) readonly buffer Tables { uvec4 quads[]; };
layout(binding = 1) readonly buffer Kappa { float kappa[]; };
layout(binding = 2) readonly buffer Lattice { float lattice[]; };
layout(binding = 3) writeonly buffer Raw { vec2 raw[]; };  // nearest, slanted

#include "screen/far_field/far_field.glsl"

shared vec2 strips[8][32];

vec2 merged(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

// What is on a lattice line between two texels. Beside the background the nearer texel decides: a
// skirt that falls to infinity within one cell would spoil the averages.
float between(float a, float b, float blend) {
  return min(a, b) > 0.0 ? fma(blend, b - a, a) : blend < 0.5 ? a : b;
}

vec2 scan_strip(Direction d, int line, int strip) {
  vec2 found = vec2(kInf, -kInf);
  const ivec2 size = plane_size();
  for (int i = 0; i < kInterval; ++i) {
    const int r = strip * kInterval - d.phase + i;
    if (r < 0 || r >= size.y) continue;
    const uvec4 rows = quads[d.rows + r / 2];
    const uvec2 row = r % 2 == 0 ? rows.xy : rows.zw;
    const int u = line * view.line_step + int(row.x);
    if (u < -1 || u >= size.x) continue;
    const int v = d.sign_v > 0 ? r : size.y - 1 - r;
    const int at = v * view.lattice_stride + view.margin + u;
    const float g = between(lattice[at], lattice[at + 1], uintBitsToFloat(row.y));
    if (!(g > 0.0)) continue;
    const float depth = depth_of(g);
    const float outward = float(d.sign_v) * (float(v) - plane_center().y) * plane_scale().y *
                          (view.orthographic != 0 ? 1.0 : depth);
    found = merged(found, vec2(depth, view.slope * outward - depth));
  }
  return found;
}

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  const int y = int(gl_LocalInvocationID.y), x = int(gl_LocalInvocationID.x);
  const Direction d = direction_at(at.z);
  vec2 found = vec2(kInf, -kInf);
  if (at.x < d.lines && at.y < int(d.strips.x)) {
    found = scan_strip(d, at.x, at.y);
    raw[(int(d.raw_rows.x) + at.y) * view.line_stride + at.x] = found;
  }
  strips[y][x] = found;
  for (int level = 1; level < 4; ++level) {
    barrier();
    if ((y & ((1 << level) - 1)) == 0) {
      found = merged(found, strips[y + (1 << (level - 1))][x]);
      strips[y][x] = found;
      const int strip = at.y >> level;
      if (at.x < d.lines && strip < int(d.strips[level])) {
        raw[(int(d.raw_rows[level]) + strip) * view.line_stride + at.x] = found;
      }
    }
  }
}
