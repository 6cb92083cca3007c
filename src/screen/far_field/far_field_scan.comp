// Algorithm 1 in parallel lines, scan_simd.cpp's ScanStrip and ScanMatter: per line and strip of rows
// the nearest depth and the greatest slanted height; of finite occluders the nearest connected piece
// and its end. A group has eight strips of 32 lines and goes on to levels 1 to 3 of the pyramid in
// shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "math/apart_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/far_field_scan_io.h"
#include "gpu/view.glsl"

#include "screen/far_field/far_field.glsl"

float row_length() { return plane_scale().y; }
#include "screen/far_field/far_field_pieces.glsl"

shared Stored strips[kStripsPerGroup][kLinesPerGroup];

// One row of a strip: where a line lies between two texels.
struct LineRow {
  int texel;
  float blend, outward;  // coordinate of the row at depth 1, or in world units
};

// False where the line is outside the image.
bool crosses(Direction d, int line, int r, out LineRow at) {
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

float slanted_at(LineRow at, float depth) {
  return slanted_height(view.slope, at.outward, depth, view.orthographic != 0);
}

Piece scan_strip(Direction d, int line, int first, int end) {
  Piece found = no_piece();
  for (int r = first; r < end; ++r) {
    LineRow at;
    if (!crosses(d, line, r, at)) continue;
    const float a = lattice[at.texel], b = lattice[at.texel + 1];
    const float g = between_texels(a, b, at.blend < 0.5 ? a : b, at.blend);
    if (!(g > 0.0)) continue;
    const float depth = depth_of(g);
    found = add_row(found, true, depth, slanted_at(at, depth));
  }
  return found;
}

Matter scan_matter(Direction d, int line, int first, int end) {
  MatterScan m = start_matter_scan();
  for (int r = first; r < end; ++r) {
    LineRow at = LineRow(0, 0.0, 0.0);
    Crossing c = Crossing(1.0, 1.0, false);
    if (crosses(d, line, r, at)) {
      c = cross_matter(lattice[at.texel], lattice[at.texel + 1], backs[at.texel],
                       backs[at.texel + 1], at.blend, at.blend < 0.5, join_slack(),
                       view.orthographic != 0);
    }
    add_matter_row(c.surface, c.depth, c.back, slanted_at(at, c.depth), at.outward, join_slack(),
                   m);
  }
  return end_matter_scan(m);
}

void store(int at, Stored found) {
  if (kFinite) {
    pieces[2 * at] = found.first;
    pieces[2 * at + 1] = found.rest;
  } else {
    raw[at] = found.first.xy;
  }
}

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  const int y = int(gl_LocalInvocationID.y), x = int(gl_LocalInvocationID.x);
  const Direction d = direction_at(at.z);
  Stored found = stored_piece(no_piece());
  if (at.x < d.lines && at.y < int(d.strips.x)) {
    const int start = at.y * kInterval - d.strip_offset;
    const int first = max(start, 0), end = min(start + kInterval, plane_size().y);
    if (kFinite) {
      found = stored_matter(scan_matter(d, at.x, first, end));
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
