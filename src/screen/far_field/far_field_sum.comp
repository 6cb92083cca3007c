// Sums (Timonen 2013, section 7) over the lines of each strip (scan_simd.cpp, sum_lines), a strip per group.
//
// The CPU sums in double, for a float sum over 2,400 lines loses 7e-5 of the depth. Here sums
// restart every 2^shift lines, the least power of two that no receiver's interval exceeds at that
// level of the pyramid, so that an interval crosses at most one restart: entry i is the sum over
// the lines from the restart before line i - 1 up to and with that line.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/taps_leaf.h"
#include "math/apart_leaf.h"
#include "screen/far_field/lattice_leaf.h"
#include "screen/far_field/scan_leaf.h"
#include "screen/far_field/far_field_sum_io.h"
#include "gpu/view.glsl"

shared vec3 partial[2][kThreads];

// Levels above the third are merged from strips of the third.
vec3 line_at(int first, int count, int line) {
  vec2 found = vec2(kInf, -kInf);
  for (int i = 0; i < count; ++i) {
    const vec2 strip = raw[(first + i) * view.line_stride + line];
    found = vec2(min(found.x, strip.x), max(found.y, strip.y));
  }
  return found.x < kInf ? vec3(found.x, outward_of(view.slope, found.x, found.y), 1.0)
                        : vec3(0.0);
}

// Lines of a phase lie beside each other.
int place_of(int entry) {
  return entry % view.phases * (view.sum_stride / view.phases) + entry / view.phases;
}

void main() {
  const int strip = int(gl_WorkGroupID.x), thread = int(gl_LocalInvocationID.x);
  const uvec4 row = quads[view.rows + strip];
  const int lines = int(row.z), restart = 1 << row.w;
  vec3 carry = vec3(0.0);
  for (int start = 0; start < lines; start += kThreads) {
    const int line = start + thread;
    vec3 sum = line < lines ? line_at(int(row.x), int(row.y), line) : vec3(0.0);
    int from = 0;
    for (int step = 1; step < min(restart, kThreads); step *= 2) {
      partial[from][thread] = sum;
      barrier();
      if ((thread & (restart - 1)) >= step) sum += partial[from][thread - step];
      from = 1 - from;
    }
    if (restart > kThreads && (start & (restart - 1)) != 0) sum += carry;
    if (line < lines) {
      const int at = strip * view.sum_stride + place_of(line + 1);
      sums[at] = sum.xy;
      counts[at] = sum.z;
    }
    partial[from][thread] = sum;
    barrier();
    carry = partial[from][kThreads - 1];
    barrier();
  }
}
