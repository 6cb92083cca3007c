// Section 10 (totals.cpp, gather): each pixel takes the far field of its accepted neighbours, each of
// which has a ninth of the directions: nine times their mean.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/cone_leaf.h"
#include "gpu/view.glsl"

layout(local_size_x = 32, local_size_y = 4) in;
layout(constant_id = 0) const int kSums = 0;  // SliceSums
layout(constant_id = 1) const bool kPaperCone = false;
layout(constant_id = 2) const bool kUnsigned = false;
layout(constant_id = 3) const bool kToImage = true;

layout(binding = 0) readonly buffer Normals { vec4 normals[]; };
layout(binding = 1) readonly buffer Accepted { uint accepted[]; };
layout(binding = 2) readonly buffer Far { float far[]; };
layout(binding = 3) buffer Totals { float totals[]; };
#define VISIBILITY_BINDING 4
#define DIRECTIONS_BINDING 5
#include "gpu/results.glsl"

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
