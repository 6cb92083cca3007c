// The slices of a group's pixels, each of which has its share of the directions, for every pixel
// (share.cpp, SharedWork::gather).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/cone_leaf.h"
#include "screen/far_field/share_leaf.h"
#include "screen/far_field/far_field_gather_io.h"
#include "gpu/direction_result.glsl"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

#include "screen/far_field/far_field_outputs.glsl"
#include "screen/far_field/far_field_totals.glsl"

#include "screen/far_field/far_field_share.glsl"

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const int pixel = p.y * view.visible_width + p.x;
  const float own_depth = share_depth(p);
  Sums sums = Sums(0.0, 0.0, vec3(0.0)), result = sums;
  if (own_depth < kInf) {
    const float weights[9] = share_weights(p, own_depth);
    float known = 0.0;
    for (int i = 0; i < 9; ++i) {
      if (weights[i] == 0.0) continue;
      const ivec2 n = p + ivec2(i % 3, i / 3) - 1;
      const int tile = tile_of(n.x, n.y, view.visible_width, kTilePixels);
      const float shares = dense[tile] != 0u ? float(kSide) : 1.0;
      known = fma(weights[i], shares, known);
      add_weighted(weights[i], totals_at(n.y * view.visible_width + n.x), sums);
    }
    add_weighted(float(kSide * kSide) / known, sums, result);
  }
  write_pixel(p, normals[pixel].xyz, result);
}
