// Which tiles are dense (share.cpp, SharedWork::prepare): a group looks at one tile.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "screen/far_field/share_leaf.h"
#include "screen/far_field/far_field_share_io.h"
#include "gpu/view.glsl"

#include "screen/far_field/far_field_share.glsl"

shared int known;

void main() {
  if (gl_LocalInvocationIndex == 0) known = 0;
  barrier();
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTilePixels;
  const ivec2 end =
      min(corner + kTilePixels, ivec2(view.visible_width, view.visible_height));
  const float shares = float(kSide * kSide);
  int own = 0;
  for (int y = corner.y + int(gl_LocalInvocationID.y) * kRowStep; y < end.y; y += 4 * kRowStep) {
    for (int x = corner.x + int(gl_LocalInvocationID.x); x < end.x; x += 32) {
      const float z = share_depth(ivec2(x, y));
      float sum = shares;
      if (z < kInf) {
        const float weights[9] = share_weights(ivec2(x, y), z);
        sum = 0.0;
        for (int i = 0; i < 9; ++i) sum += weights[i];
      }
      own += int(sum * float(kKnownUnits) + 0.5);
    }
  }
  atomicAdd(known, own);
  barrier();
  if (gl_LocalInvocationIndex != 0) return;
  const ivec2 size = end - corner;
  const int all = kKnownUnits * kSide * kSide * size.x * ((size.y + kRowStep - 1) / kRowStep);
  dense[tile_of(corner.x, corner.y, view.visible_width, kTilePixels)] =
      float(known) < kEnough * float(all) ? 1u : 0u;
}
