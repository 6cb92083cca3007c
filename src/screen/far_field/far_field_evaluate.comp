// Slices of a few directions for every receiver (slices_simd.cpp): near samples, then one read per
// interval. Invocations beside each other read neighbouring texels and lines. Which of them is a
// table's affair (lines.h), equal for a row: the processor's numbers to the last bit.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#define PASS_CONSTANTS                                              \
  float rho_radius, inverse_radius, entries_per_length;             \
  int last_entry, rho_start;                                        \
  int transposed, lattice_stride, margin, directions, direction_count; \
  int sum_stride, add;
#include "vulkan/view.glsl"

layout(local_size_x = 32, local_size_y = 4) in;
layout(constant_id = 0) const int kFalloff = 1;  // FalloffKind
layout(constant_id = 1) const bool kChord = true;
layout(constant_id = 2) const int kSums = 0;      // SliceSums
layout(constant_id = 3) const int kMode = 0;      // 0 whole; section 10: 1 near field, 2 far field
layout(constant_id = 4) const int kPhases = 1;    // of a row's receivers
layout(constant_id = 5) const int kLineStep = 1;
layout(constant_id = 6) const int kSegments = 2;

layout(binding = 0) readonly buffer Tables { uvec4 quads[]; };
layout(binding = 1) readonly buffer Kappa { float kappa[]; };
layout(binding = 2) readonly buffer Lattice { float lattice[]; };
layout(binding = 3) readonly buffer Receivers { vec4 receivers[]; };
layout(binding = 4) readonly buffer LineSums { vec2 line_sums[]; };
layout(binding = 5) readonly buffer Counts { float counts[]; };
layout(binding = 6) buffer PlaneSums { float sums[]; };

#include "screen/far_field/far_field.glsl"


float rho_table(int i) { return uintBitsToFloat(quads[view.rho_start + i / 4][i % 4]); }

#include "math/falloff.glsl"
#include "math/slab.glsl"
#include "screen/far_field/far_field_slices.glsl"

const int kNearAlone = 1, kFarAlone = 2;
const int kLinePhases = kPhases / kLineStep;

// What the receivers of a row read: see far_field_program.cpp.
struct Reads {
  int taps, tap_count, intervals, interval_count;
  vec3 slopes;
};
Reads reads_at(int header) {
  const uvec4 a = quads[header], b = quads[header + 1];
  Reads reads;
  reads.taps = int(a.x);
  reads.tap_count = int(a.y & 0xffff);
  reads.interval_count = int(a.y >> 16);
  reads.intervals = int(a.z);
  reads.slopes = uintBitsToFloat(b.xyz);
  return reads;
}

void add_taps(Receiver r, Part part, Reads reads, int at, int row_step, inout Horizon h) {
  for (int k = 0; k < reads.tap_count; ++k) {
    const uvec4 tap = quads[reads.taps + k];
    const float along = uintBitsToFloat(tap.x);
    const vec2 weight = uintBitsToFloat(tap.yz);
    const int i = at + int(tap.w);
    float g = fma(weight.x, lattice[i + 1] - lattice[i], lattice[i]);
    if (weight.y > 0.0) {
      const int j = i + row_step;
      g = fma(weight.y, fma(weight.x, lattice[j + 1] - lattice[j], lattice[j]) - g, g);
    }
    const float q = depth_of(max(g, kSmallest));
    const float rows = along * (view.orthographic != 0 ? 1.0 : q);
    add_point(part.slice, point_in(r, part, q, rows), g > 0.0, h);
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

void add_intervals(Receiver r, Part part, Reads reads, Direction d, int line, float axis,
                   inout Horizon h) {
  for (int k = 0; k < reads.interval_count; ++k) {
    const uvec4 interval = quads[reads.intervals + k];
    const int row = (d.row_base + int(interval.x & 0xffffff)) * view.sum_stride;
    const int first = clamp(line + int(interval.y), 0, d.lines);
    const int last = clamp(line + int(interval.z), 0, d.lines);
    const vec3 sum = sum_between(row, int(interval.x >> 24), first, last);
    const float inverse = 1.0 / max(sum.z, 1.0);
    const float q = inverse * sum.x;
    const float rows =
        inverse * sum.y / plane_scale().y + axis * (view.orthographic != 0 ? 1.0 : q);
    add_part(part.slice, point_in(r, part, q, rows), sum.z > 0.0,
             sum.z * uintBitsToFloat(interval.w), h);
  }
}

// Which of 3x3 cells a pixel is, the image's way.
int cell_of(ivec2 p) {
  const ivec2 image = turned(p) % 3;
  return 3 * image.y + image.x;
}

void main() {
  const int phase = int(gl_GlobalInvocationID.z);
  const ivec2 visible = plane_visible();
  const int pixel_step = kMode == kNearAlone ? 1 : kPhases;
  const ivec2 p = ivec2(int(gl_GlobalInvocationID.x) * pixel_step + phase, gl_GlobalInvocationID.y);
  if (p.x >= visible.x || p.y >= visible.y) return;
  const int pixel = p.y * visible.x + p.x;
  const ivec2 at = p + plane_corner();
  const int texel = at.y * view.lattice_stride + view.margin + at.x;
  const vec4 given = receivers[pixel];
  const float g = kMode == kFarAlone ? lattice_value(given.w) : lattice[texel];
  const Receiver r = receiver_at(p, g, given.xyz);
  Totals totals = Totals(0.0, 0.0, vec3(0.0));
  for (int i = 0; r.surface && i < view.direction_count; ++i) {
    const Direction d = direction_at(i);
    if (kMode == kFarAlone && d.group != cell_of(p)) continue;
    const float axis = -float(d.sign_v) * (float(at.y) - plane_center().y);
    for (int segment = 0; segment < kSegments; ++segment) {
      const Reads reads = reads_at(d.headers + 2 * ((p.y * kPhases + phase) * kSegments + segment));
      const Part part = make_part(r, float(d.sign_v), reads.slopes);
      Horizon h = start_horizon(part.slice, reads.tap_count > 0);
      add_taps(r, part, reads, texel, d.sign_v * view.lattice_stride, h);
      if (kMode == kFarAlone) {
        h.sum = h.sum_solid = 0.0;
        h.sum_directions = vec2(0.0);
      }
      if (kMode != kNearAlone) {
        add_intervals(r, part, reads, d, p.x / kPhases * kLinePhases, axis, h);
      }
      add_slice(part, h.sum, h.sum_directions, h.sum_solid, totals);
    }
  }
  store_totals(pixel, visible.x * visible.y, totals);
}
