// The far field of 3x3 pixels (Timonen 2013, section 10; totals.cpp, gather): each pixel takes nine
// times the mean of its accepted neighbours, each of which has a ninth of the directions.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/cone_leaf.h"
#include "screen/far_field/far_field_gather_io.h"
#include "gpu/direction_result.glsl"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

#include "screen/far_field/far_field_outputs.glsl"
#define STORES_TOTALS
#include "screen/far_field/far_field_totals.glsl"

Sums far_at(int pixel) {
  Sums sums = Sums(far[pixel], 0.0, vec3(0.0));
  if (kSums == 0) return sums;
  for (int c = 0; c < 3; ++c) sums.directions[c] = far[(1 + c) * pixels() + pixel];
  sums.solid = far[4 * pixels() + pixel];
  return sums;
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const int pixel = p.y * view.visible_width + p.x;
  const uint mask = accepted[pixel];
  const float weight = 9.0 / float(max(bitCount(mask), 1));
  Sums sums = totals_at(pixel);
  for (int bit = 0; bit < 9; ++bit) {
    if ((mask & (1u << bit)) == 0u) continue;
    const int other = pixel + (bit / 3 - 1) * view.visible_width + bit % 3 - 1;
    add_weighted(weight, far_at(other), sums);
  }
  if (kToImage) {
    write_pixel(p, normals[pixel].xyz, sums);
  } else {
    store_totals(pixel, sums);
  }
}
