// For parallel view rays twice the greatest depth (Plane::ortho_offset), so that what is interpolated grows
// towards the camera and is 0 on the background. In two steps: groups of pixels, then the groups.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/far_field_range_io.h"
#include "gpu/view.glsl"

shared float partial[kThreads];

void main() {
  const int thread = int(gl_LocalInvocationIndex), groups = int(gl_NumWorkGroups.x);
  if (view.orthographic == 0) return;
  float most = 0.0;
  for (int i = int(gl_WorkGroupID.x) * kThreads + thread; i < view.count; i += groups * kThreads) {
    const float d = depth[i];
    most = d < kInf ? max(most, d) : most;
  }
  partial[thread] = most;
  for (int half_size = kThreads / 2; half_size > 0; half_size /= 2) {
    barrier();
    if (thread < half_size) partial[thread] = max(partial[thread], partial[thread + half_size]);
  }
  if (thread == 0) greatest[gl_WorkGroupID.x] = view.last != 0 ? 2.0 * partial[0] : partial[0];
}
