// Pieces of matter of one level of the pyramid from the level below, beyond the levels that the scan
// makes: in pairs, for what is joined depends on the order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "math/apart_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/far_field_merge_io.h"
#include "gpu/view.glsl"

const bool kFinite = true;
float row_length() { return view.transposed != 0 ? view.scale_x : view.scale_y; }
#include "screen/far_field/far_field_pieces.glsl"

Stored load(int at) { return Stored(pieces[2 * at], pieces[2 * at + 1]); }

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  // Where the level begins and its strips, the same of the level below.
  const ivec4 merge = ivec4(quads[view.merges + at.z]);
  if (at.x >= view.line_stride || at.y >= merge.y) return;
  const int first = 2 * at.y, second = first + 1;
  Stored m = load((merge.z + first) * view.line_stride + at.x);
  if (second < merge.w) m = merged(m, load((merge.z + second) * view.line_stride + at.x));
  const int to = (merge.x + at.y) * view.line_stride + at.x;
  pieces[2 * to] = m.first;
  pieces[2 * to + 1] = m.rest;
}
