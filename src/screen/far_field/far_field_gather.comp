// The slices of a group's pixels, each of which has its share of the directions, for every pixel
// (totals.cpp, gather).
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

// Eye space with y down and z away from the camera.
SharePoint point_at(ivec2 p, float z) {
  const vec2 axis = vec2(p + ivec2(view.left, view.top)) + 0.5 - vec2(view.center_u, view.center_v);
  const vec2 at = axis * vec2(view.scale_x, view.scale_y) * (view.orthographic != 0 ? 1.0 : z);
  const vec3 n = normals[p.y * view.visible_width + p.x].xyz;
  return SharePoint(at.x, at.y, z, n.x, -n.y, -n.z);
}

float depth_at(ivec2 p) { return depth[(p.y + view.top) * view.width + p.x + view.left]; }

// In a window of 3 x 3 pixels, those of one share lie alike for every pixel.
int share_of(ivec2 k) {
  return kSide == 2 ? 2 * (k.y & 1) + (k.x & 1) : 3 * (k.y + 1) + k.x + 1;
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = ivec2(view.visible_width, view.visible_height);
  if (p.x >= size.x || p.y >= size.y) return;
  const int pixel = p.y * size.x + p.x;
  const float own_depth = depth_at(p);
  Sums sums = Sums(0.0, 0.0, vec3(0.0));
  if (own_depth < kInf) {
    const SharePoint own = point_at(p, own_depth);
    const float inverse_footprint =
        1.0 / ((view.orthographic != 0 ? 1.0 : own_depth) * max(view.scale_x, view.scale_y));
    float weight[9], weights[9] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (int i = 0; i < 9; ++i) {
      const ivec2 k = ivec2(i % 3, i / 3) - 1, n = p + k;
      const bool inside = all(greaterThanEqual(n, ivec2(0))) && all(lessThan(n, size));
      const float z = inside ? depth_at(n) : kInf;
      weight[i] = z < kInf ? weight_apart(k.x * k.x + k.y * k.y) : 0.0;
      if (i != 4 && z < kInf) {
        weight[i] *= weight_of_surface(own, point_at(n, z), inverse_footprint);
      }
      weights[share_of(k)] += weight[i];
    }
    float certain = 0.0, scale = 0.0;
    for (int s = 0; s < kSide * kSide; ++s) {
      const float certainty = share_certainty(weights[s]);
      certain += weights[s] * certainty;
      scale += certainty;
    }
    for (int i = 0; i < 9; ++i) {
      if (weight[i] == 0.0) continue;
      const ivec2 k = ivec2(i % 3, i / 3) - 1;
      add_weighted(weight[i] * share_certainty(weights[share_of(k)]),
                   totals_at(pixel + k.y * size.x + k.x), sums);
    }
    // What a share lacks in weight it takes from the mean of all.
    const Sums found = sums;
    add_weighted(kMeanWeight * scale / max(certain, 1e-6), found, sums);
  }
  write_pixel(p, normals[pixel].xyz, sums);
}
