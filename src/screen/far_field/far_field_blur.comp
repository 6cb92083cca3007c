// Mean over the neighbours within two pixels whose visibility is within 7 % of the pixel's own and
// which see the same surface (totals.cpp, blur_selectively); what decides lies in shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/cone_leaf.h"
#include "screen/far_field/blur_leaf.h"
#include "screen/far_field/far_field_blur_io.h"
#include "gpu/direction_result.glsl"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

#include "screen/far_field/far_field_outputs.glsl"
#include "screen/far_field/far_field_totals.glsl"

const int kReach = kBlurReach;
const int kStride = kWidth + 2 * kReach, kRows = kHeight + 2 * kReach;

shared vec2 tile[kRows * kStride];  // obscurance, depth; no depth outside

void load_tile(ivec2 corner) {
  for (int i = int(gl_LocalInvocationIndex); i < kRows * kStride; i += kThreads) {
    const ivec2 p = corner + ivec2(i % kStride, i / kStride) - kReach;
    const bool inside = all(greaterThanEqual(p, ivec2(0))) && p.x < view.visible_width &&
                        p.y < view.visible_height;
    const int pixel = p.y * view.visible_width + p.x;
    tile[i] = inside ? vec2(totals[pixel], depth[(p.y + view.top) * view.width + p.x + view.left]) : vec2(0.0, kInf);
  }
  barrier();
}

void main() {
  load_tile(ivec2(gl_WorkGroupID.xy) * ivec2(kWidth, kHeight));
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const int pixel = p.y * view.visible_width + p.x;
  const int at = (int(gl_LocalInvocationID.y) + kReach) * kStride +
                 int(gl_LocalInvocationID.x) + kReach;
  const vec2 own = tile[at];
  Sums sums = Sums(0.0, 0.0, vec3(0.0));
  float weights = 0.0;
  for (int i = 0; own.y < kInf && i < 25; ++i) {
    const ivec2 d = ivec2(i % 5, i / 5);
    const ivec2 k = d - kReach;
    const vec2 other = tile[at + k.y * kStride + k.x];
    if (!blurs(own.x, other.x, own.y, other.y)) continue;
    const float weight = blur_weight(abs(k.x), abs(k.y));
    weights += weight;
    if (kSums == 0) {
      sums.obscurance += weight * other.x;
    } else {
      add_weighted(weight, totals_at(pixel + k.y * view.visible_width + k.x), sums);
    }
  }
  Sums mean = totals_at(pixel);
  if (weights > 0.0) {
    mean = Sums(0.0, 0.0, vec3(0.0));
    add_weighted(1.0 / weights, sums, mean);
  }
  write_pixel(p, normals[pixel].xyz, mean);
}
