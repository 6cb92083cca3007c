// One level of the pyramid of moments (moments.h) from the level before, as MomentPyramid::pack_level.
// Level l is kept at the texels of level l - 1: those of its own are among them, and where a sample
// sees both levels it wants the next one's moments at its own place. Each group does a tile: it loads
// the tile's surroundings, merges their columns, then the rows, in shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/apart_leaf.h"
#include "screen/volumetric/area/moments_leaf.h"
#include "screen/volumetric/area/moments_io.h"
#include "gpu/view.glsl"
#include "screen/volumetric/area/moments.glsl"

const int kReach = 4, kSide = kTile + 2 * kReach;
const float kWeights[5] = float[](1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);

// Share of surface, mean and variance.
shared vec3 cells[kSide * kSide];
shared vec3 columns[kTile * kSide];

vec3 load(ivec2 p) {
  if (p.x < 0 || p.y < 0 || p.x >= view.to_width || p.y >= view.to_height) return vec3(0.0);
  const int at = view.from + view.keep * (p.y * view.from_width + p.x);
  if (kFirst) return depth[at] < kInf ? vec3(1.0, depth[at], 0.0) : vec3(0.0);
  const vec3 m = unpack_moments(moments[at]);
  return vec3(m.x, m.y, m.z * m.z);
}

vec3 merge(vec3 cell[5]) {
  float w[5], m[5], v[5], sum = 0.0;
  for (int k = 0; k < 5; ++k) {
    w[k] = kMomentWeights[k] * cell[k].x;
    m[k] = cell[k].y;
    v[k] = cell[k].z;
  }
  const float nearest = nearest_mean(w, m, view.slack);
  for (int k = 0; k < 5; ++k) {
    w[k] = weight_beside(nearest, w[k], m[k]);
    m[k] = mean_beside(nearest, m[k]);
    sum += w[k];
  }
  if (!(sum > 0.0)) return vec3(0.0);
  const float per_sum = 1.0 / sum, average = merged_mean(w, m, per_sum);
  return vec3(sum, average, merged_variance(w, m, v, average) * per_sum);
}

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile;
  for (int i = int(gl_LocalInvocationIndex); i < kSide * kSide; i += kThreads) {
    cells[i] = load(corner + ivec2(i % kSide, i / kSide) - kReach);
  }
  barrier();
  vec3 cell[5];
  for (int i = int(gl_LocalInvocationIndex); i < kTile * kSide; i += kThreads) {
    const int at = i + kReach * kSide;
    for (int k = 0; k < 5; ++k) cell[k] = cells[at + (k - 2) * view.tap_step * kSide];
    columns[i] = merge(cell);
  }
  barrier();
  for (int i = int(gl_LocalInvocationIndex); i < kTile * kTile; i += kThreads) {
    const ivec2 p = corner + ivec2(i % kTile, i / kTile);
    if (p.x >= view.to_width || p.y >= view.to_height) continue;
    const int at = i / kTile * kSide + i % kTile + kReach;
    for (int k = 0; k < 5; ++k) cell[k] = columns[at + (k - 2) * view.tap_step];
    const vec3 m = merge(cell);
    moments[view.to + p.y * view.to_width + p.x] = pack_moments(m.x, m.y, sqrt(m.z));
  }
}
