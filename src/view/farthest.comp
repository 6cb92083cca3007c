// The largest finite depth of the whole image, one part of it per group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "gpu/view.glsl"

layout(local_size_x = 128) in;
layout(binding = 0) readonly buffer Depth { float depth[]; };
layout(binding = 1) writeonly buffer Farthest { float farthest[]; };

shared uint largest;  // depths are positive: their order is that of their bits

void main() {
  if (gl_LocalInvocationIndex == 0) largest = 0;
  barrier();
  float mine = 0.0;
  const uint step = gl_NumWorkGroups.x * 128, pixels = uint(view.width * view.height);
  for (uint i = gl_GlobalInvocationID.x; i < pixels; i += step) {
    if (depth[i] < kInf) mine = max(mine, depth[i]);
  }
  atomicMax(largest, floatBitsToUint(mine));
  barrier();
  if (gl_LocalInvocationIndex == 0) farthest[gl_WorkGroupID.x] = uintBitsToFloat(largest);
}
