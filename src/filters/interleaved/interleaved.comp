// From the sums of an interleaved pattern to results (interleaved.cpp): the edge-aware blur over the
// m x m pixels that share the pattern, rows first, then columns, and directions and cones. Each group
// does a tile of the image with its surroundings in shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "filters/edge_leaf.h"
#include "math/slab_leaf.h"
#include "math/cone_leaf.h"
#include "filters/interleaved/interleaved_io.h"
#include "gpu/direction_result.glsl"
#include "gpu/view.glsl"
#include "gpu/visibility_target.glsl"

const int kSide = kTile + 2 * kReach, kCells = kSide * kSide;
shared float surface[kCells];  // linear on planes; 0: background
shared float normal[3 * kCells];
shared float value[kChannels * kCells];
shared float blurred[kChannels * kTile * kSide];  // rows of kTile

// All that the tile reads.
void load(ivec2 corner) {
  for (int i = int(gl_LocalInvocationIndex); i < kCells; i += kThreads) {
    const ivec2 p = corner + ivec2(i % kSide, i / kSide) - kReach;
    const bool inside = p.x >= 0 && p.y >= 0 && p.x < view.visible_width && p.y < view.visible_height;
    const float z = inside ? depth[(p.y + view.top) * view.width + p.x + view.left] : kInf;
    surface[i] = z < kInf ? (view.orthographic != 0 ? z : 1.0 / z) : 0.0;
    if (!(z < kInf)) continue;
    const int at = p.y * view.visible_width + p.x;
    const vec3 n = kNormals ? normals[at].xyz : vec3(0.0, 0.0, 1.0);
    for (int c = 0; c < 3; ++c) normal[c * kCells + i] = n[c];
    if (kOpen) value[i] = open_sums[at];
    if (!kDirections) continue;
    const vec4 v = sums[at];
    for (int c = 0; c < 4; ++c) value[(kChannels - 4 + c) * kCells + i] = v[c];
  }
}

vec3 normal_at(int i) { return vec3(normal[i], normal[kCells + i], normal[2 * kCells + i]); }

float slope_at(int i, int step) {
  const float s = surface[i], next = surface[i + step], last = surface[i - step];
  const float after = next > 0.0 ? next - s : kInf, before = last > 0.0 ? s - last : kInf;
  return surface_slope(after, before);
}

// Weight of tap k: by how near its surface lies to the continuation of the receiver's, and by how
// alike the normals are.
float tap_weight(int i, int k, int step, float slope, float per_edge, vec3 n) {
  const float s = surface[i + k * step];
  const float gap = gap_to_surface(s, surface[i], slope, float(k), per_edge);
  if (!(s > 0.0)) return 0.0;
  return weight_of_tap(gap, dot(n, normal_at(i + k * step))) *
         (kHalfOutermost && abs(k) == kReach ? 0.5 : 1.0);
}

float per_edge_at(int i) {
  const float inverse_edge = inverse_of_edge(1.0 / max(0.5 * view.radius, 1e-30), surface[i],
                                             view.edges_per_depth, view.orthographic != 0);
  return edges_per_unit(surface[i], inverse_edge, view.orthographic != 0);
}

void blur_rows() {
  for (int t = int(gl_LocalInvocationIndex); t < kTile * kSide; t += kThreads) {
    const int i = t / kTile * kSide + t % kTile + kReach;
    if (!(surface[i] > 0.0)) continue;
    const float slope = slope_at(i, 1), per_edge = per_edge_at(i);
    const vec3 n = normal_at(i);
    float sum[kChannels], whole = 1.0;
    for (int c = 0; c < kChannels; ++c) sum[c] = value[c * kCells + i];
    for (int k = -kReach; k <= kReach; ++k) {
      if (k == 0) continue;
      const float w = tap_weight(i, k, 1, slope, per_edge, n);
      whole += w;
      if (!(w > 0.0)) continue;
      for (int c = 0; c < kChannels; ++c) sum[c] += w * value[c * kCells + i + k];
    }
    for (int c = 0; c < kChannels; ++c) blurred[c * kTile * kSide + t] = sum[c] / whole;
  }
}

void blur_column(int i, int t, out float result[kChannels]) {
  for (int c = 0; c < kChannels; ++c) result[c] = blurred[c * kTile * kSide + t];
  const float slope = slope_at(i, kSide), per_edge = per_edge_at(i);
  const vec3 n = normal_at(i);
  float whole = 1.0;
  for (int k = -kReach; k <= kReach; ++k) {
    if (k == 0) continue;
    const float w = tap_weight(i, k, kSide, slope, per_edge, n);
    whole += w;
    if (!(w > 0.0)) continue;
    for (int c = 0; c < kChannels; ++c) {
      result[c] += w * blurred[c * kTile * kSide + t + k * kTile];
    }
  }
  for (int c = 0; c < kChannels; ++c) result[c] /= whole;
}

void store_direction(ivec2 p, vec3 direction, float angle) {
  const vec3 stored = kUnsigned ? 0.5 * direction + 0.5 : direction;
  write_direction(p, vec4(stored, angle / 1.57079633));
}

void finish_direction(ivec2 p, vec3 n, vec3 difference, float seen) {
  float open = seen;
  if (kCosineOpen) open = uniform_open(seen, dot(n, difference));
  const vec3 integral = open * n + 2.0 * difference;
  const BentCone cone = bent_cone(kPaperCone, integral.x, integral.y, integral.z, 2.0 * open, n.x,
                                  n.y, n.z);
  store_direction(p, vec3(cone.x, cone.y, cone.z), cone.angle);
}

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile;
  load(corner);
  barrier();
  if (kReach > 0) blur_rows();
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += kThreads / kTile) {
    const ivec2 cell = ivec2(int(gl_LocalInvocationID.x), y), p = corner + cell;
    if (p.x >= view.visible_width || p.y >= view.visible_height) continue;
    const int i = (cell.y + kReach) * kSide + cell.x + kReach;
    if (!(surface[i] > 0.0)) {
      store_visibility(p, 1.0);
      if (kDirections) store_direction(p, vec3(0.0, 0.0, 1.0), 1.57079633);
      continue;
    }
    float result[kChannels];
    if (kReach > 0) {
      blur_column(i, (cell.y + kReach) * kTile + cell.x, result);
    } else {
      for (int c = 0; c < kChannels; ++c) result[c] = value[c * kCells + i];
    }
    store_visibility(p, result[kOpen ? 0 : kChannels - 1]);
    if (kDirections) {
      const int c = kChannels - 4;
      finish_direction(p, normal_at(i), vec3(result[c], result[c + 1], result[c + 2]),
                       result[kChannels - 1]);
    }
  }
}
