// The same where matter has an end (matter_simd.cpp): each sample and each interval's piece marks the
// sectors between its two ends.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/far_field_matter_io.h"
#include "screen/far_field/far_field_evaluate.glsl"
#include "math/sectors_leaf.h"
#include "math/matter_leaf.h"
#include "screen/far_field/box_leaf.h"

const bool kFinite = true;
float row_length() { return plane_scale().y; }
#include "screen/far_field/far_field_pieces.glsl"

// A piece outwards from row `first` to row `last`; `rows` is times depth unless view rays are
// parallel.
void add_piece(Part part, float depth, float back, float rows, float first, float last, float dither,
               inout Sectors m) {
  const MatterBox box =
      matter_box(part, rows, first, last, depth, back, view.orthographic != 0);
  add_matter(part.slice, box, first - m.last_row < kNextRow, join_slack() * depth, dither, true, m);
}

// What else a line's interval holds, `row` rows to its middle.
void add_others(Part part, Rest rest, float row, int interval, float dither, inout Sectors m) {
  if (!(rest.front < depth_without_effect(part.depth))) return;
  const bool parallel = view.orthographic != 0;
  const MatterBox box = matter_box(part, parallel ? row : row * rest.front, row, row, rest.front,
                                   max(rest.back, rest.front), parallel);
  add_spread(part.slice, box, rest_share(rest), dither, interval, true, m);
}

void add_taps(Part part, Reads reads, Place place, inout Sectors m) {
  const float limit = depth_without_effect(part.depth);
  for (int k = 0; k < reads.tap_count; ++k) {
    const uvec4 tap = quads[reads.taps + k];
    const float row = uintBitsToFloat(tap.x), wu = uintBitsToFloat(tap.y);
    const int i = place.texel + int(tap.w);
    const Crossing c = cross_matter(lattice[i], lattice[i + 1], backs[i], backs[i + 1], wu,
                                    wu < 0.5, join_slack(),
                                    view.orthographic != 0);
    if (!c.surface || !(c.depth < limit)) {
      m.joined = false;
      continue;
    }
    const float rows = view.orthographic != 0 ? row : row * c.depth;
    add_piece(part, c.depth, c.back, rows, row, row, reads.dither, m);
  }
}

void add_intervals(Part part, Reads reads, Direction d, Place place, inout Sectors m) {
  const float rows_per_length = 1.0 / plane_scale().y, limit = depth_without_effect(part.depth);
  for (int k = 0; k < reads.interval_count; ++k) {
    const uvec4 interval = quads[reads.intervals + k];
    const int row = (d.row_base + int(interval.x & 0xffffff)) * view.sum_stride;
    const int line = place.line + int(interval.y);
    const bool inside = line >= 0 && line < d.lines;
    const int at = 2 * (row + line);
    if (!inside || !(lines[at].x < limit)) {
      m.joined = false;
      continue;
    }
    const Matter found = loaded_matter(Stored(lines[at], lines[at + 1]));
    const Piece p = found.first;
    const float outward = outward_of(view.slope, p.nearest, p.slanted);
    const float axis = view.orthographic != 0 ? place.axis : place.axis * p.nearest;
    add_piece(part, p.nearest, p.deepest, outward * rows_per_length + axis,
              p.begin * rows_per_length + place.axis, p.end * rows_per_length + place.axis,
              reads.dither, m);
    add_others(part, found.rest, uintBitsToFloat(interval.z), k, reads.dither, m);
  }
}

void evaluate_slice(Receiver r, Part part, Reads reads, Direction d, Place place,
                    inout Totals totals) {
  const float back = max(backs[place.texel], r.depth);
  Sectors m = start_sectors(part.slice, reads.tap_count > 0, r.depth, back);
  add_taps(part, reads, place, m);
  add_intervals(part, reads, d, place, m);
  add_slice(part, middle_of(float(d.sign_v), reads.slopes), m.sum, vec2(m.sum_x, m.sum_y),
            m.sum_solid, totals);
}
