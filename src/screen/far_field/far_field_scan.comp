// Algorithm 1 in parallel lines, scan_simd.cpp's ScanStrip and ScanMatter: per line and strip of rows
// the nearest depth and the greatest slanted height; of finite occluders the nearest connected piece
// and its end. A group has eight strips of 32 lines and goes on to levels 1 to 3 of the pyramid in
// shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/far_field_scan_io.h"
#include "gpu/view.glsl"

#include "screen/far_field/far_field.glsl"
#include "screen/far_field/far_field_pieces.glsl"

shared vec3 strips[kStripsPerGroup][kLinesPerGroup];

// One row of a strip: where a line lies between two texels.
struct Crossing {
  int texel;
  float blend, outward;  // coordinate of the row at depth 1, or in world units
};

// False where the line is outside the image.
bool crosses(Direction d, int line, int r, out Crossing at) {
  const ivec2 size = plane_size();
  const uvec4 rows = quads[d.rows + r / 2];
  const uvec2 row = r % 2 == 0 ? rows.xy : rows.zw;
  const int u = line * view.line_step + int(row.x);
  const int v = d.sign_v > 0 ? r : size.y - 1 - r;
  at.texel = v * view.lattice_stride + view.margin + u;
  at.blend = uintBitsToFloat(row.y);
  at.outward = float(d.sign_v) * (float(v) - plane_center().y) * plane_scale().y;
  return u >= -1 && u < size.x;
}

float slanted_at(Crossing at, float depth) {
  return view.slope * at.outward * (view.orthographic != 0 ? 1.0 : depth) - depth;
}

// Beside the background the nearer texel decides: a skirt that falls to infinity within one cell
// would spoil the averages.
float between(float a, float b, float blend) {
  return min(a, b) > 0.0 ? fma(blend, b - a, a) : blend < 0.5 ? a : b;
}

vec3 scan_strip(Direction d, int line, int first, int end) {
  vec3 found = no_piece();
  for (int r = first; r < end; ++r) {
    Crossing at;
    if (!crosses(d, line, r, at)) continue;
    const float g = between(lattice[at.texel], lattice[at.texel + 1], at.blend);
    if (!(g > 0.0)) continue;
    const float depth = depth_of(g);
    found = vec3(min(found.x, depth), max(found.y, slanted_at(at, depth)), 0.0);
  }
  return found;
}

// Depth of a row's matter and where it ends; none: infinity and 0. Between texels whose matter does
// not touch, the nearer one decides.
vec2 matter_at(Crossing at) {
  const float a = lattice[at.texel], b = lattice[at.texel + 1];
  const float back_a = backs[at.texel], back_b = backs[at.texel + 1];
  const float da = depth_of(max(a, kSmallest)), db = depth_of(max(b, kSmallest));
  const bool both = min(a, b) > 0.0 &&
                    max(da, db) - min(back_a, back_b) <= join_slack() * min(da, db);
  const bool first = at.blend < 0.5;
  const float g = both ? fma(at.blend, b - a, a) : first ? a : b;
  const float depth = depth_of(max(g, kSmallest));
  return g > 0.0 ? vec2(depth, max(first ? back_a : back_b, depth)) : vec2(kInf, 0.0);
}

vec3 nearer(vec3 a, vec3 b) { return a.x < b.x ? a : b; }

vec3 scan_matter(Direction d, int line, int first, int end) {
  vec3 best = no_piece(), piece = no_piece();
  vec2 before = vec2(kInf, 0.0);
  for (int r = first; r < end; ++r) {
    Crossing at;
    vec2 matter = vec2(kInf, 0.0);
    if (crosses(d, line, r, at)) matter = matter_at(at);
    if (matter.x < kInf) {
      const float height = slanted_at(at, matter.x);
      const bool joined = before.x < kInf && max(matter.x, before.x) - min(matter.y, before.y) <=
                                                 join_slack() * min(matter.x, before.x);
      if (joined) {
        piece = vec3(min(piece.x, matter.x), max(piece.y, height), max(piece.z, matter.y));
      } else {
        best = nearer(piece, best);
        piece = vec3(matter.x, height, matter.y);
      }
    } else {
      best = nearer(piece, best);
      piece = no_piece();
    }
    before = matter;
  }
  return nearer(piece, best);
}

void store(int at, vec3 found) {
  if (kFinite) {
    pieces[at] = vec4(found, 0.0);
  } else {
    raw[at] = found.xy;
  }
}

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  const int y = int(gl_LocalInvocationID.y), x = int(gl_LocalInvocationID.x);
  const Direction d = direction_at(at.z);
  vec3 found = no_piece();
  if (at.x < d.lines && at.y < int(d.strips.x)) {
    const int start = at.y * kInterval - d.strip_offset;
    const int first = max(start, 0), end = min(start + kInterval, plane_size().y);
    if (kFinite) {
      found = scan_matter(d, at.x, first, end);
    } else {
      found = scan_strip(d, at.x, first, end);
    }
    store((int(d.raw_rows.x) + at.y) * view.line_stride + at.x, found);
  }
  strips[y][x] = found;
  for (int level = 1; level < kSharedLevels; ++level) {
    barrier();
    if ((y & ((1 << level) - 1)) == 0) {
      found = merged(found, strips[y + (1 << (level - 1))][x]);
      strips[y][x] = found;
      const int strip = at.y >> level;
      if (at.x < d.lines && strip < int(d.strips[level])) {
        store((int(d.raw_rows[level]) + strip) * view.line_stride + at.x, found);
      }
    }
  }
}
