// Horizons along a few directions, horizon_simd.cpp in GLSL; symbols as there. One pixel per
// invocation, one sum of an interleaved pattern each (filters/interleaved).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "math/slice_leaf.h"
#include "math/sectors_leaf.h"
#include "view/taps_leaf.h"
#include "screen/horizon/lines_leaf.h"
#include "screen/horizon/box_leaf.h"
#include "screen/horizon/horizon_io.h"
#include "gpu/view.glsl"

float rho_table(int i) { return tables[3 * (kDirections + kInterleave * kInterleave) + i]; }

#include "gpu/rho.glsl"
#include "math/horizon_leaf.h"
#include "math/matter_leaf.h"
#include "screen/horizon/slices_leaf.h"

LineReceiver receiver_at(ivec2 at, float z, vec3 n) {
  const bool parallel = view.orthographic != 0;
  const vec2 ray = (parallel ? 0.0 : 1.0) *
                   (vec2(at) - (vec2(view.center_u, view.center_v) - 0.5)) *
                   vec2(view.scale_x, view.scale_y);
  return make_line_receiver(float(at.x), float(at.y), z, n.x, n.y, n.z, ray.x, ray.y, parallel);
}

// A sample's texel: its place, how far it is from the receiver in pixels times the size of a pixel,
// and along the line in pixels.
struct Texel {
  int index;
  vec2 k;
  float pixels;
};
Texel texel_at(LineReceiver r, ImageLine line, float shift, int j) {
  Texel t;
  t.pixels = sample_at(line, shift, float(j), 1.0 / float(kSteps), !kClassic);
  const vec2 at = vec2(r.u, r.v), size = vec2(view.width, view.height);
  const vec2 texel =
      clamp(at + roundEven(t.pixels * vec2(line.du, line.dv)), vec2(0.0), size - 1.0);
  t.index = int(texel.y) * view.width + int(texel.x);
  t.k = (texel - at) * vec2(view.scale_x, view.scale_y);
  return t;
}
LinePoint point_of(LineReceiver r, ImageLine line, Texel t) {
  return line_point(r, line, t.k.x, t.k.y, depth[t.index], view.orthographic != 0);
}
LinePoint point_at(LineReceiver r, ImageLine line, float shift, int j) {
  return point_of(r, line, texel_at(r, line, shift, j));
}

// Where the matter of a texel ends that begins at `front` on the ray (a, b, 1).
float back_of(float front, int index, vec2 ray) {
  if (kMatter == kOfThickness) {
    return back_of_thickness(front, view.thickness, ray.x, ray.y, view.orthographic != 0);
  }
  return max(min(backs[index], kFarBack), front);
}

Obscured matter_slice(LineReceiver r, ImageLine line, Slice s, float shift, float own) {
  const bool parallel = view.orthographic != 0;
  const float footprint = max(view.scale_x, view.scale_y);
  Sectors m = start_sectors(s, true, r.z, own);
  float before = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    const Texel t = texel_at(r, line, shift, j);
    const LinePoint p = point_of(r, line, t);
    const float between = t.pixels - before;
    before = t.pixels;
    if (!p.valid) {
      m.joined = false;
      continue;
    }
    const float front = depth[t.index];
    const float back = back_of(front, t.index, vec2(r.a, r.b) + t.k);
    const float distance = parallel ? r.distance : front;
    const MatterBox box =
        line_box(s, p, reach_of_sample(line, between, distance), front, back, parallel);
    const float slack = slack_of_samples(footprint * distance, between);
    add_matter(s, box, true, slack, shift - 0.5, true, m);
  }
  return finish_sectors(m);
}

Obscured constant_slice(LineReceiver r, ImageLine line, Slice s, float shift) {
  float cosine = s.edge_cosine;
  for (int j = 0; j < kSteps; ++j) {
    const LinePoint p = point_at(r, line, shift, j);
    if (p.valid) {
      cosine = max(cosine, cut_cosine(s, p.x, p.y, view.rho_radius, view.inverse_radius));
    }
  }
  return finish_constant(s, cosine);
}

Obscured falling_slice(LineReceiver r, ImageLine line, Slice s, float shift) {
  Horizon h = start_horizon(s, true);
  for (int j = 0; j < kSteps; ++j) {
    const LinePoint p = point_at(r, line, shift, j);
    add_point(s, p.x, p.y, p.valid, false, 1.0, h);
  }
  return finish_falling(h);
}

Obscured classic_slice(LineReceiver r, ImageLine line, float shift) {
  ClassicHorizon h = start_classic(r, line, view.bias_sine, view.bias_cosine);
  for (int j = 0; j < kSteps; ++j) {
    add_classic(point_at(r, line, shift, j), 1.0 / (view.radius * view.radius), h);
  }
  return finish_classic(h);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const ivec2 at = p + ivec2(view.left, view.top);
  const int i = p.y * view.visible_width + p.x;
  const float z = depth[at.y * view.width + at.x];
  const vec3 n = normals[i].xyz;
  LineReceiver r = receiver_at(at, z < kInf ? z : 1.0, n);
  if (!kClassic) r.limit = depth_without_effect(r.z);
  const float perspective = view.orthographic != 0 ? 0.0 : 1.0;
  const float camera = view.orthographic != 0 ? 1.0 : r.z * r.ray_length;
  const ivec2 place = pattern_place(p) % kInterleave;
  const int tile = 3 * (kDirections + place.y * kInterleave + place.x);
  float own = r.z;
  if (kMatter != kSolid && z < kInf) own = back_of(r.z, at.y * view.width + at.x, vec2(r.a, r.b));
  const vec2 tile_turn = vec2(tables[tile], tables[tile + 1]);
  ObscuredSums sum = nothing_obscured();
  for (int k = 0; z < kInf && k < kDirections; ++k) {
    const vec2 d = vec2(tables[3 * k], tables[3 * k + 1]);
    const vec2 turn = vec2(d.x * tile_turn.x - d.y * tile_turn.y,
                           d.y * tile_turn.x + d.x * tile_turn.y);
    const float shift = fract(tables[tile + 2] + tables[3 * k + 2]);
    const ImageLine line =
        make_image_line(r, turn.x, turn.y, 1.0 / view.scale_x, 1.0 / view.scale_y, view.radius,
                        float(view.width - 1), float(view.height - 1));
    Obscured obscured;
    if (kClassic) {
      obscured = classic_slice(r, line, shift);
    } else {
      const Slice s = make_slice(r.nz, line.nt, camera, perspective);
      if (kMatter != kSolid) {
        obscured = matter_slice(r, line, s, shift, own);
      } else if (kFalloff == kConstantRho) {
        obscured = constant_slice(r, line, s, shift);
      } else {
        obscured = falling_slice(r, line, s, shift);
      }
    }
    add_obscured(obscured, turn.x, turn.y, true, sum);
  }
  const float each = 1.0 / float(kDirections);
  const float open = 1.0 - sum.visibility * (kClassic ? each : 2.0 * each);
  if (kSums == kSumVisibility) {
    open_sums[i] = open;
    return;
  }
  const EyeVector lost =
      obscured_in_eye_space(r, n.x, n.y, n.z, sum, 0.5 * each * sum.solid, each);
  sums[i] = vec4(lost.x, lost.y, lost.z, open);
}
