// Matter as thick as it is wide (view/widths.cpp, back_from_widths): first the runs along columns, then
// those along rows and the lesser of both. Along a line a run is j (1 + the neighbour's run): a chain
// of such steps is again of the form a + b run, so each thread sums up its part of a line, and then
// goes over it with what comes in from the parts before and behind.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "view/widths_leaf.h"
#include "view/widths_io.h"
#include "gpu/view.glsl"

shared vec2 forward[kParts][kLines], backward[kParts][kLines];

int texel_of(int line, int i) {
  return kAcross ? line * view.width + i : i * view.width + line;
}
float joined_at(int line, int i, int count) {  // of texels i and i + 1
  if (i < 0 || i + 1 >= count) return 0.0;
  return joined_part(depth[texel_of(line, i)], depth[texel_of(line, i + 1)],
                     kAcross ? view.scale_x : view.scale_y, view.orthographic != 0);
}

void main() {
  const int lane = int(gl_LocalInvocationID.x), part = int(gl_LocalInvocationID.y);
  const int line = int(gl_WorkGroupID.x) * kLines + lane;
  const int lines = kAcross ? view.height : view.width;
  const int count = kAcross ? view.width : view.height;
  const int size = (count + kParts - 1) / kParts;
  const int first = min(part * size, count), end = min(first + size, count);
  const bool inside = line < lines;

  // Both chains through the part, the run that comes in being unknown: x + y run.
  vec2 from_left = vec2(0.0, 1.0), from_right = vec2(0.0, 1.0);
  for (int i = first; inside && i < end; ++i) {
    const float before = joined_at(line, i - 1, count), behind = joined_at(line, i, count);
    from_left = vec2(run_beside(from_left.x, before), before * from_left.y);
    // What is farther to the right comes in first.
    from_right = vec2(from_right.x + from_right.y * behind, from_right.y * behind);
  }
  forward[part][lane] = from_left;
  backward[part][lane] = from_right;
  barrier();
  if (!inside) return;

  float run = 0.0;
  for (int k = 0; k < part; ++k) run = forward[k][lane].x + forward[k][lane].y * run;
  for (int i = first; i < end; ++i) {
    run = run_beside(run, joined_at(line, i - 1, count));
    runs[texel_of(line, i)] = run;
  }
  run = 0.0;
  for (int k = kParts - 1; k > part; --k) run = backward[k][lane].x + backward[k][lane].y * run;
  for (int i = end - 1; i >= first; --i) {
    run = run_beside(run, joined_at(line, i, count));
    const int at = texel_of(line, i);
    const float length = runs[at] + 1.0 + run;
    runs[at] = kAcross ? back_of_runs(depth[at], length, down[at], view.scale_x, view.scale_y,
                                      view.orthographic != 0)
                       : length;
  }
}
