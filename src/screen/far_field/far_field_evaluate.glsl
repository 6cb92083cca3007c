// What both evaluations have in common (solid and finite occluders): a pixel an invocation, a few
// directions in registers. Invocations beside each other read neighbouring texels and lines; which of
// them is a table's affair (lines.h), equal for a row: the processor's numbers to the last bit.
// Afterwards: evaluate_slice().
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "math/slice_leaf.h"
#include "view/taps_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/slices_leaf.h"
#define PASS_CONSTANTS                                                 \
  float rho_radius, inverse_radius, entries_per_length;                \
  int last_entry, rho_start;                                           \
  int transposed, lattice_stride, margin, directions, direction_count; \
  int sum_stride, add;                                                 \
  float slope;
#include "gpu/view.glsl"

layout(local_size_x = 32, local_size_y = 4) in;
layout(constant_id = 0) const int kFalloff = 1;  // FalloffKind
layout(constant_id = 1) const bool kChord = true;
layout(constant_id = 2) const int kSums = 0;    // SliceSums
layout(constant_id = 3) const int kMode = 0;    // 0 whole; section 10: 1 near field, 2 far field
layout(constant_id = 4) const int kPhases = 1;  // of a row's receivers
layout(constant_id = 5) const int kLineStep = 1;
layout(constant_id = 6) const int kSegments = 2;
layout(constant_id = 7) const bool kJitter = false;

layout(binding = 0) readonly buffer Tables { uvec4 quads[]; };
layout(binding = 1) readonly buffer Kappa { float kappa[]; };
layout(binding = 2) readonly buffer Lattice { float lattice[]; };
layout(binding = 3) readonly buffer Receivers { vec4 receivers[]; };
layout(binding = 4) buffer PlaneSums { float sums[]; };

#include "screen/far_field/far_field.glsl"

float rho_table(int i) { return uintBitsToFloat(quads[view.rho_start + i / 4][i % 4]); }

#include "gpu/rho.glsl"
#include "math/horizon_leaf.h"
#include "screen/far_field/far_field_slices.glsl"

const int kNearAlone = 1, kFarAlone = 2;
const int kLinePhases = kPhases / kLineStep;

// What the receivers of a row read: see far_field_program.cpp.
struct Reads {
  int taps, tap_count, intervals, interval_count;
  vec3 slopes;
  float dither;
};
Reads reads_at(int header) {
  const uvec4 a = quads[header], b = quads[header + 1];
  Reads reads;
  reads.taps = int(a.x);
  reads.tap_count = int(a.y & 0xffff);
  reads.interval_count = int(a.y >> 16);
  reads.intervals = int(a.z);
  reads.slopes = uintBitsToFloat(b.xyz);
  reads.dither = uintBitsToFloat(b.w);
  return reads;
}

// A receiver's place among texels and lines, for one direction.
struct Place {
  int texel, row_step;  // in the lattice; to the next row outwards
  int line;
  float axis;  // the camera's axis, in rows outwards from the receiver
};

// Adds what the slice of one segment obscures.
void evaluate_slice(Receiver r, Part part, Reads reads, Direction d, Place place,
                    inout Totals totals);

// Which of 3x3 cells a pixel is in this frame, the image's way.
int cell_of(ivec2 p) {
  const ivec2 image = pattern_place(turned(p)) % 3;
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
  const int cell = cell_of(p);
  // Receivers of a row and a cell that stand alike between scanned lines read alike.
  const int alike = ((kJitter ? 9 * p.y + cell : p.y) * kLineStep + p.x % kLineStep) * kSegments;
  for (int i = 0; r.surface && i < view.direction_count; ++i) {
    const Direction d = direction_at(i);
    if (kMode == kFarAlone && d.group != cell) continue;
    const Place place =
        Place(texel, d.sign_v * view.lattice_stride, p.x / kLineStep,
              -float(d.sign_v) * (float(at.y) - plane_center().y));
    for (int segment = 0; segment < kSegments; ++segment) {
      const Reads reads = reads_at(d.headers + 2 * (alike + segment));
      evaluate_slice(r, part_of(r, float(d.sign_v), reads.slopes), reads, d, place, totals);
    }
  }
  store_totals(pixel, visible.x * visible.y, totals);
}
