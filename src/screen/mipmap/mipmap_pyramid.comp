// Five levels of the depth pyramid (mipmap.cpp, build) from one: a group takes 32x32 texels and halves
// them in shared memory. Means or minima of the finite depths among four; 0 where none is.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/apart_leaf.h"
#include "screen/mipmap/mipmap_leaf.h"
#include "screen/mipmap/mipmap_pyramid_io.h"
#include "gpu/view.glsl"


#define WRITES_PYRAMID
#include "screen/mipmap/mipmap.glsl"

shared float tiles[2][kTile * kTile];

// Texel 2 p of a tile `size` a side and its neighbours, those beyond the level's edge again.
float halved(int from, int size, ivec2 p, ivec2 last) {
  const ivec2 a = 2 * p, b = min(a + 1, last);
  const float four[4] = float[](tiles[from][a.y * size + a.x], tiles[from][a.y * size + b.x],
                                tiles[from][b.y * size + a.x], tiles[from][b.y * size + b.x]);
  return depth_of_four(four, kMean);
}

void main() {
  const int thread = int(gl_LocalInvocationIndex);
  const ivec2 group = ivec2(gl_WorkGroupID.xy);
  const ivec2 source_size = level_size(view.source);
  for (int i = thread; i < kTile * kTile; i += kThreads) {
    const ivec2 p = min(group * kTile + ivec2(i % kTile, i / kTile), source_size - 1);
    tiles[0][i] = texel_of(view.source, p);
  }
  int from = 0;
  for (int k = 1; k <= kLevelsPerPass; ++k) {
    barrier();
    const int size = kTile >> k, level = view.source + k;
    if (level < view.count) {
      const ivec2 corner = group * size, level_end = level_size(level) - 1;
      // The last texel of the finer level, in this tile.
      const ivec2 last = level_size(level - 1) - 1 - 2 * corner;
      for (int i = thread; i < size * size; i += kThreads) {
        const ivec2 p = ivec2(i % size, i / size);
        if (any(greaterThan(corner + p, level_end))) continue;
        const float value = halved(from, 2 * size, p, last);
        tiles[1 - from][i] = value;
        store_texel(level, corner + p, value);
      }
    }
    from = 1 - from;
  }
}
