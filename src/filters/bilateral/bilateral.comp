// Edge-aware separable blur of visibility, as bilateral_simd.cpp. Each group does a tile: it loads
// the tile's surroundings, blurs their rows in shared memory, then the tile's columns, so that
// nothing goes through memory between the two directions.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "filters/edge_leaf.h"
#include "filters/bilateral/bilateral_io.h"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

const int kReach = 4;
const int kStride = kTileWidth + 2 * kReach, kRows = kTileHeight + 2 * kReach;

shared float surfaces[kRows * kStride];  // linear on planes; 0: background or outside
shared float inputs[kRows * kStride];
shared float blurred[kRows * kTileWidth];  // along rows

void load(ivec2 corner) {
  for (int i = int(gl_LocalInvocationIndex); i < kRows * kStride; i += kThreads) {
    const ivec2 p = corner + ivec2(i % kStride, i / kStride) - kReach;
    float s = 0.0, v = 0.0;
    if (all(greaterThanEqual(p, ivec2(0))) && p.x < view.visible_width &&
        p.y < view.visible_height) {
      const float z = depth[(p.y + view.top) * view.width + p.x + view.left];
      if (z < kInf) s = view.orthographic != 0 ? z : 1.0 / z;
      v = values[p.y * view.visible_width + p.x];
    }
    surfaces[i] = s;
    inputs[i] = v;
  }
}

// What one pixel knows of its surface in one direction.
struct Receiver {
  float surface, slope, per_edge;
};

Receiver receiver_at(int i, int step) {
  const float s = surfaces[i], last = surfaces[i - step], next = surfaces[i + step];
  const float after = next > 0.0 ? next - s : kInf, before = last > 0.0 ? s - last : kInf;
  return Receiver(s, surface_slope(after, before),
                  edges_per_unit(s, 1.0 / view.edge, view.orthographic != 0));
}

float tap_weight(Receiver r, int i, int step, int k) {
  const float s = surfaces[i + k * step];
  const float gap = gap_to_surface(s, r.surface, r.slope, float(k), r.per_edge);
  return s > 0.0 ? edge_weight(gap) * kBinomial[abs(k)] : 0.0;
}

float blur_row(int i) {
  const float v0 = inputs[i];
  if (!(surfaces[i] > 0.0)) return v0;
  const Receiver r = receiver_at(i, 1);
  float sum = 0.0, weights = kBinomial[0];
  for (int k = -kReach; k <= kReach; ++k) {
    if (k == 0) continue;
    const float w = tap_weight(r, i, 1, k);
    sum += w * (inputs[i + k] - v0);
    weights += w;
  }
  return v0 + sum / weights;
}

// Of surface i, which is blurred[j].
float blur_column(int i, int j) {
  const Receiver r = receiver_at(i, kStride);
  const float v0 = blurred[j];
  float sum = 0.0, weights = kBinomial[0];
  for (int k = -kReach; k <= kReach; ++k) {
    if (k == 0) continue;
    const float w = tap_weight(r, i, kStride, k);
    sum += w * (blurred[j + k * kTileWidth] - v0);
    weights += w;
  }
  return v0 + sum / weights;
}

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * ivec2(kTileWidth, kTileHeight);
  load(corner);
  barrier();
  for (int i = int(gl_LocalInvocationIndex); i < kRows * kTileWidth; i += kThreads) {
    blurred[i] = blur_row(i / kTileWidth * kStride + i % kTileWidth + kReach);
  }
  barrier();
  for (int i = int(gl_LocalInvocationIndex); i < kTileHeight * kTileWidth; i += kThreads) {
    const ivec2 cell = ivec2(i % kTileWidth, i / kTileWidth), p = corner + cell;
    if (p.x >= view.visible_width || p.y >= view.visible_height) continue;
    const int at = (cell.y + kReach) * kStride + cell.x + kReach;
    const bool surface = surfaces[at] > 0.0;
    write_visibility(p, surface ? blur_column(at, i + kReach * kTileWidth) : 1.0);
  }
}
