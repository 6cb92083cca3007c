// Slices of a few directions for every receiver (slices_simd.cpp): near samples, then one read per
// interval.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/far_field_evaluate_io.h"
#include "screen/far_field/far_field_evaluate.glsl"

float blended_beside(float nearest, float a, float b, float blend) {
  const bool parallel = view.orthographic != 0;
  return blended(texel_beside(nearest, a, parallel), texel_beside(nearest, b, parallel), blend);
}

void add_taps(Receiver r, Part part, Reads reads, Place place, inout Horizon h) {
  const float limit = depth_without_effect(r.depth);
  const bool parallel = view.orthographic != 0;
  for (int k = 0; k < reads.tap_count; ++k) {
    const uvec4 tap = quads[reads.taps + k];
    const float along = uintBitsToFloat(tap.x);
    const vec2 weight = uintBitsToFloat(tap.yz);
    const int i = place.texel + int(tap.w);
    const float a = lattice[i], b = lattice[i + 1];
    float nearest = nearest_of_lattice(a, b, parallel), g;
    if (weight.y > 0.0) {
      const int j = i + place.row_step;
      const float c = lattice[j], e = lattice[j + 1];
      nearest = nearest_of_lattice(nearest, nearest_of_lattice(c, e, parallel), parallel);
      g = blended(blended_beside(nearest, a, b, weight.x),
                  blended_beside(nearest, c, e, weight.x), weight.y);
    } else {
      g = blended_beside(nearest, a, b, weight.x);
    }
    const float q = depth_of(max(g, kSmallest));
    const float rows = along * (view.orthographic != 0 ? 1.0 : q);
    add_point(part.slice, part_x(part, rows), part_y(part, q, rows), g > 0.0 && q < limit, false,
              1.0, h);
  }
}

// Entry i of the sums over a strip's lines.
vec3 entry(int row, int i) {
  const int at = row + i % kLinePhases * (view.sum_stride / kLinePhases) + i / kLinePhases;
  return vec3(line_sums[at], counts[at]);
}

// Lines from `first` up to `last` of a strip; sums restart every 2^shift lines.
vec3 sum_between(int row, int shift, int first, int last) {
  if (first >= last) return vec3(0.0);
  vec3 sum = entry(row, last);
  if ((first & ((1 << shift) - 1)) != 0) sum -= entry(row, first);
  const int before = first >> shift;
  if (before != (last - 1) >> shift) sum += entry(row, (before + 1) << shift);
  return sum;
}

void add_intervals(Receiver r, Part part, Reads reads, Direction d, Place place,
                   inout Horizon h) {
  const float rows_per_outward = 1.0 / plane_scale().y;
  const float limit = depth_without_effect(r.depth);
  for (int k = 0; k < reads.interval_count; ++k) {
    const uvec4 interval = quads[reads.intervals + k];
    const int row = (d.row_base + int(interval.x & 0xffffff)) * view.sum_stride;
    const int first = clamp(place.line + int(interval.y), 0, d.lines);
    const int last = clamp(place.line + int(interval.z), 0, d.lines);
    const vec3 sum = sum_between(row, int(interval.x >> 24), first, last);
    const float inverse = 1.0 / max(sum.z, 1.0);
    const float q = inverse * sum.x;
    const float rows =
        inverse * sum.y * rows_per_outward + place.axis * (view.orthographic != 0 ? 1.0 : q);
    add_point(part.slice, part_x(part, rows), part_y(part, q, rows),
              sum.z > 0.0 && q < limit, true, sum.z * uintBitsToFloat(interval.w), h);
  }
}

void evaluate_slice(Receiver r, Part part, Reads reads, Direction d, Place place,
                    inout Totals totals) {
  Horizon h = start_horizon(part.slice, reads.tap_count > 0);
  add_taps(r, part, reads, place, h);
  add_intervals(r, part, reads, d, place, h);
  add_slice(part, middle_of(float(d.sign_v), reads.slopes), h.sum, vec2(h.sum_x, h.sum_y),
            h.sum_solid, totals);
}
