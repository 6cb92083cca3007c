// Pieces of matter of one level of the pyramid from the level below, beyond the levels that the scan
// makes: in pairs, for what is joined depends on the order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/far_field_merge_io.h"
#include "gpu/view.glsl"

const bool kFinite = true;
#include "screen/far_field/far_field_pieces.glsl"

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  // Where the level begins and its strips, the same of the level below.
  const ivec4 merge = ivec4(quads[view.merges + at.z]);
  if (at.x >= view.line_stride || at.y >= merge.y) return;
  const int first = 2 * at.y, second = min(first + 1, merge.w - 1);
  const vec3 a = pieces[(merge.z + first) * view.line_stride + at.x].xyz;
  const vec3 b = pieces[(merge.z + second) * view.line_stride + at.x].xyz;
  pieces[(merge.x + at.y) * view.line_stride + at.x] = vec4(merged(a, b), 0.0);
}
