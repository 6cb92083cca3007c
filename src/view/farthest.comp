// The largest finite depth of the whole image, one part of it per group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "view/farthest_io.h"
#include "gpu/view.glsl"

shared uint largest;  // depths are positive: their order is that of their bits

void main() {
  if (gl_LocalInvocationIndex == 0) largest = 0;
  barrier();
  float mine = 0.0;
  const uint step = gl_NumWorkGroups.x * kThreads, pixels = uint(view.width * view.height);
  for (uint i = gl_GlobalInvocationID.x; i < pixels; i += step) {
    if (depth[i] < kInf) mine = max(mine, depth[i]);
  }
  atomicMax(largest, floatBitsToUint(mine));
  barrier();
  if (gl_LocalInvocationIndex == 0) farthest[gl_WorkGroupID.x] = uintBitsToFloat(largest);
}
