// The same where matter has an end (matter_simd.cpp): each sample and each interval's piece marks the
// sectors between its two ends.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/far_field_matter_io.h"
#include "screen/far_field/far_field_evaluate.glsl"
#include "math/sectors_leaf.h"
#include "math/matter_leaf.h"

// A point outwards, `rows` being times depth unless view rays are parallel.
void add_piece(Receiver r, Part part, float depth, float back, float rows, float dither,
               inout Sectors m) {
  const float x = part_x(part, rows), y = part_y(part, depth, rows);
  const MatterEnd end = matter_end(part, x, y, depth, back, view.orthographic != 0);
  add_matter(part.slice, x, y, end.x, end.y, depth, back, join_slack() * depth, dither, true, m);
}

void add_taps(Receiver r, Part part, Reads reads, Place place, inout Sectors m) {
  for (int k = 0; k < reads.tap_count; ++k) {
    const uvec4 tap = quads[reads.taps + k];
    const float along = uintBitsToFloat(tap.x);
    const vec2 w = uintBitsToFloat(tap.yz);
    const bool centred = (tap.w & 1u) != 0u;
    const int i = place.texel + (int(tap.w) >> 1), j = w.y > 0.0 ? i + place.row_step : i;
    const float a = lattice[i], b = lattice[i + 1], c = lattice[j], e = lattice[j + 1];
    const float first_back = min(min(backs[i], backs[i + 1]), min(backs[j], backs[j + 1]));
    const int nearest = (w.y >= 0.5 ? j : i) + (w.x >= 0.5 ? 1 : 0);
    const MatterTap found =
        matter_tap(a, b, c, e, w.x, w.y, lattice[nearest], backs[nearest], first_back,
                   join_slack(), ortho_offset[0], view.orthographic != 0);
    if (!(found.surface && (found.smooth_here || centred))) {
      m.joined = false;
      continue;
    }
    add_piece(r, part, found.depth, found.back,
              along * (view.orthographic != 0 ? 1.0 : found.depth), reads.dither, m);
  }
}

void add_intervals(Receiver r, Part part, Reads reads, Direction d, Place place, inout Sectors m) {
  for (int k = 0; k < reads.interval_count; ++k) {
    const uvec4 interval = quads[reads.intervals + k];
    const int row = (d.row_base + int(interval.x & 0xffffff)) * view.sum_stride;
    const int line = place.line + int(interval.y);
    const bool inside = line >= 0 && line < d.lines;
    const vec3 piece = inside ? lines[row + line].xyz : vec3(kInf);
    if (!(piece.x < kInf)) {
      m.joined = false;
      continue;
    }
    const float rows = outward_of(view.slope / plane_scale().y, piece.x, piece.y) +
                       place.axis * (view.orthographic != 0 ? 1.0 : piece.x);
    add_piece(r, part, piece.x, piece.z, rows, reads.dither, m);
  }
}

void evaluate_slice(Receiver r, Part part, Reads reads, Direction d, Place place,
                    inout Totals totals) {
  const float back = max(backs[place.texel], r.depth);
  Sectors m = start_sectors(part.slice, reads.tap_count > 0, r.depth, back);
  add_taps(r, part, reads, place, m);
  if (kMode == kFarAlone) {
    m.sum = m.sum_x = m.sum_y = m.sum_solid = 0.0;
  }
  if (kMode != kNearAlone) add_intervals(r, part, reads, d, place, m);
  add_slice(part, middle_of(float(d.sign_v), reads.slopes), m.sum, vec2(m.sum_x, m.sum_y),
            m.sum_solid, totals);
}
