// Linear depth of any kind of depth image; background is +inf (view/geometry.cpp, convert).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#include "math/azimuth_leaf.h"
#include "view/depth_leaf.h"
#include "view/depth_io.h"
#include "gpu/view.glsl"

// `reversed` is 1 near and 0 far, `forward` the opposite; both keep precision at their own end.
float from_ndc(float reversed, float forward) {
  if (!(reversed > 0.0 && forward >= 0.0)) return kInf;
  return depth_of_ndc(reversed, forward, view.near_plane, view.far_plane, view.orthographic != 0,
                      isinf(view.far_plane));
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.width || p.y >= view.height) return;
  const float v = texelFetch(depth_image, p, 0).r;
  float d = v;
  if (kDepthKind == 1 && view.orthographic == 0) {
    const float a = (float(p.x) + 0.5 - view.center_u) * view.scale_x;
    const float b = (view.center_v - (float(p.y) + 0.5)) * view.scale_y;
    d = depth_of_distance(v, a, b);
  }
  if (kDepthKind == 2) d = from_ndc(1.0 - v, v);
  if (kDepthKind == 3) d = from_ndc(v, 1.0 - v);
  depth[p.y * view.width + p.x] = d > 0.0 && d < min(view.far_plane, kFarthestDepth) ? d : kInf;
}
