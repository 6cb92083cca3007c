// Algorithm 1 in parallel lines, scan_simd.cpp's ScanStrip and ScanMatter: per line and strip of rows
// the nearest depth and the greatest slanted height; of finite occluders the nearest connected piece
// and its end. A group has eight strips of 32 lines and goes on to levels 1 to 3 of the pyramid in
// shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
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
  return slanted_height(view.slope, at.outward, depth, view.orthographic != 0);
}

Piece scan_strip(Direction d, int line, int first, int end) {
  Piece found = no_piece();
  for (int r = first; r < end; ++r) {
    Crossing at;
    if (!crosses(d, line, r, at)) continue;
    const float a = lattice[at.texel], b = lattice[at.texel + 1];
    const float g = between_texels(a, b, at.blend < 0.5 ? a : b, at.blend);
    if (!(g > 0.0)) continue;
    const float depth = depth_of(g);
    found = add_row(found, true, depth, slanted_at(at, depth));
  }
  return found;
}

Piece scan_matter(Direction d, int line, int first, int end) {
  MatterScan m = start_matter_scan();
  for (int r = first; r < end; ++r) {
    Crossing at = Crossing(0, 0.0, 0.0);
    bool surface = false;
    float depth = 1.0, back = 1.0;
    if (crosses(d, line, r, at)) {
      const float a = lattice[at.texel], b = lattice[at.texel + 1];
      const float back_a = backs[at.texel], back_b = backs[at.texel + 1];
      const bool nearer = at.blend < 0.5;
      const float g = between_matter(a, b, nearer ? a : b, at.blend, depth_of(max(a, kSmallest)),
                                     depth_of(max(b, kSmallest)), back_a, back_b, join_slack());
      surface = g > 0.0;
      depth = depth_of(max(g, kSmallest));
      back = max(nearer ? back_a : back_b, depth);
    }
    add_matter_row(surface, depth, back, slanted_at(at, depth), join_slack(), m);
  }
  return nearer_piece(m.piece, m.best);
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
  vec3 found = stored_piece(no_piece());
  if (at.x < d.lines && at.y < int(d.strips.x)) {
    const int start = at.y * kInterval - d.strip_offset;
    const int first = max(start, 0), end = min(start + kInterval, plane_size().y);
    if (kFinite) {
      found = stored_piece(scan_matter(d, at.x, first, end));
    } else {
      found = stored_piece(scan_strip(d, at.x, first, end));
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
