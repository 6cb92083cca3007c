// Sums of both orientations in the image (totals.cpp, collect); the transposed ones come through
// shared memory. Writes what was asked for, or the sums for the passes that share them out.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/cone_leaf.h"
#include "screen/far_field/far_field_collect_io.h"
#include "gpu/direction_result.glsl"
#include "gpu/results.glsl"
#include "gpu/view.glsl"

#include "screen/far_field/far_field_outputs.glsl"
#define STORES_TOTALS
#include "screen/far_field/far_field_totals.glsl"

shared float tile[kTile][kTile + 1];

void load_tile(ivec2 corner, int channel) {
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    const ivec2 p = corner.yx + ivec2(gl_LocalInvocationID.x, y);
    if (p.x < view.visible_height && p.y < view.visible_width) {
      tile[y][gl_LocalInvocationID.x] =
          turned[channel * pixels() + p.y * view.visible_height + p.x];
    }
  }
  barrier();
}

// Directions along the image's axes and the view ray become eye space's.
vec3 eye_space(ivec2 p, vec3 directions) {
  const vec2 axis = vec2(p + ivec2(view.left, view.top)) -
                    (vec2(view.center_u, view.center_v) - 0.5);
  const vec2 ray =
      view.orthographic != 0 ? vec2(0.0) : axis * vec2(view.scale_x, view.scale_y);
  const float along = directions.z / sqrt(1.0 + dot(ray, ray));
  return vec3(directions.x + along * ray.x, -directions.y - along * ray.y, -along);
}

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kTile;
  const ivec2 at = ivec2(gl_LocalInvocationID.xy);
  // Of this invocation's four pixels: obscurance, directions, solid angle.
  float found[4][5];
  for (int c = 0; c < (kSums == 0 ? 1 : 5); ++c) {
    // The transposed plane's u is the image's v.
    load_tile(corner, c == 1 ? 2 : c == 2 ? 1 : c);
    for (int i = 0; i < 4; ++i) {
      const ivec2 p = corner + at + ivec2(0, 8 * i);
      if (p.x >= view.visible_width || p.y >= view.visible_height) continue;
      found[i][c] = straight[c * pixels() + p.y * view.visible_width + p.x] +
                    tile[at.x][at.y + 8 * i];
    }
  }
  for (int i = 0; i < 4; ++i) {
    const ivec2 p = corner + at + ivec2(0, 8 * i);
    if (p.x >= view.visible_width || p.y >= view.visible_height) continue;
    const int pixel = p.y * view.visible_width + p.x;
    Sums sums = Sums(found[i][0], 0.0, vec3(0.0));
    if (kSums != 0) {
      sums.directions = eye_space(p, vec3(found[i][1], found[i][2], found[i][3]));
      sums.solid = found[i][4];
    }
    if (kToImage) {
      write_pixel(p, normals[pixel].xyz, sums);
      continue;
    }
    store_totals(pixel, sums);
  }
}
