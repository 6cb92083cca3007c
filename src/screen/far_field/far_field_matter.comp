// The same where matter has an end (matter_simd.cpp): each sample and each interval's piece marks the
// sectors between its two ends.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/far_field_matter_io.h"
#include "screen/far_field/far_field_evaluate.glsl"
#include "math/matter.glsl"

// A point outwards, `rows` being times depth unless view rays are parallel.
void add_piece(Receiver r, Part part, float depth, float back, float rows, float dither,
               inout Sectors m) {
  const vec2 p = point_in(r, part, depth, rows);
  // The matter's end lies on the same view ray.
  const float scale = back / depth, camera = part.slice.camera;
  const vec2 end = view.orthographic != 0 ? vec2(p.x, p.y - (back - depth))
                                          : vec2(p.x * scale, (p.y - camera) * scale + camera);
  add_matter(part.slice, p, end, depth, back, join_slack() * depth, dither, m);
}

// A direct sample: blended between four texels of one surface, otherwise the nearest of them, which
// stands at its own row only.
void add_taps(Receiver r, Part part, Reads reads, Place place, inout Sectors m) {
  for (int k = 0; k < reads.tap_count; ++k) {
    const uvec4 tap = quads[reads.taps + k];
    const float along = uintBitsToFloat(tap.x);
    const vec2 w = uintBitsToFloat(tap.yz);
    const bool centred = (tap.w & 1u) != 0u;
    const int i = place.texel + (int(tap.w) >> 1), j = w.y > 0.0 ? i + place.row_step : i;
    const float a = lattice[i], b = lattice[i + 1], c = lattice[j], e = lattice[j + 1];
    const float least = min(min(a, b), min(c, e)), most = max(max(a, b), max(c, e));
    const float first_back = min(min(backs[i], backs[i + 1]), min(backs[j], backs[j + 1]));
    const float far = depth_of(max(least, kSmallest)), near = depth_of(max(most, kSmallest));
    const bool smooth_here = least > 0.0 && far - first_back <= join_slack() * near;
    if (!smooth_here && !centred) {
      m.joined = false;
      continue;
    }
    const int nearest = (w.y >= 0.5 ? j : i) + (w.x >= 0.5 ? 1 : 0);
    const float top = fma(w.x, b - a, a), bottom = fma(w.x, e - c, c);
    const float g = smooth_here ? fma(w.y, bottom - top, top) : lattice[nearest];
    if (!(g > 0.0)) {
      m.joined = false;
      continue;
    }
    const float depth = depth_of(g);
    add_piece(r, part, depth, max(backs[nearest], depth),
              along * (view.orthographic != 0 ? 1.0 : depth), reads.dither, m);
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
    const float rows = view.slope / plane_scale().y * (piece.y + piece.x) +
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
    m.sum = m.sum_solid = 0.0;
    m.sum_directions = vec2(0.0);
  }
  if (kMode != kNearAlone) add_intervals(r, part, reads, d, place, m);
  add_slice(part, m.sum, m.sum_directions, m.sum_solid, totals);
}
