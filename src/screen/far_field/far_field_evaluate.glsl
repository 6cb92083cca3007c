// What both evaluations have in common (solid and finite occluders): a pixel an invocation, a few
// directions in registers. Invocations beside each other read neighbouring texels and lines; which of
// them is a table's affair (lines.h), equal for a row: the CPU's numbers to the last bit.
// After a header with OBSCURA_EVALUATION (evaluation_io.h); afterwards: evaluate_slice().
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "math/slice_leaf.h"
#include "view/taps_leaf.h"
#include "math/apart_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/slices_leaf.h"
#include "screen/far_field/share_leaf.h"
#include "gpu/view.glsl"

#include "screen/far_field/far_field.glsl"

float rho_table(int i) { return uintBitsToFloat(quads[view.rho_start + i / 4][i % 4]); }

#include "gpu/rho.glsl"
#include "math/horizon_leaf.h"
#include "screen/far_field/far_field_slices.glsl"

const int kLinePhases = kPhases / kLineStep;

// What the receivers of a row read: see gpu_tables.cpp.
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

// Does a pixel evaluate a direction? `cell` is the pixel's place in its group in this frame.
bool evaluates(ivec2 p, ivec2 cell, int share) {
  if (kJitter || kSide == 1) return true;
  const ivec2 image = turned(p);
  return has_share(share_of_cell(cell.y, cell.x, kSide), share, kSide,
                   dense[tile_of(image.x, image.y, view.visible_width, kTilePixels)] != 0u);
}

void main() {
  const int phase = int(gl_GlobalInvocationID.z);
  const ivec2 visible = plane_visible();
  const ivec2 p = ivec2(int(gl_GlobalInvocationID.x) * kPhases + phase, gl_GlobalInvocationID.y);
  if (p.x >= visible.x || p.y >= visible.y) return;
  const int pixel = p.y * visible.x + p.x;
  const ivec2 at = p + plane_corner();
  const int texel = at.y * view.lattice_stride + view.margin + at.x;
  const vec3 normal = receivers[pixel].xyz;
  const Receiver r = receiver_at(p, lattice[texel], normal);
  Totals totals = Totals(0.0, 0.0, vec3(0.0));
  const ivec2 cell = pattern_place(turned(p)) % kSide;
  // Receivers of a row and a cell that stand alike between scanned lines read alike.
  const int row = kJitter ? 9 * p.y + 3 * cell.y + cell.x : p.y;
  const int alike = (row * kLineStep + p.x % kLineStep) * kSegments;
  for (int i = 0; r.surface && i < view.direction_count; ++i) {
    const Direction d = direction_at(i);
    if (!evaluates(p, cell, d.share)) continue;
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
