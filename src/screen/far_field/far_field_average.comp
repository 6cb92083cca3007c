// Groups of 3x3 pixels (Timonen 2013, section 10; totals.cpp, average_groups): which of 3x3
// neighbours see the pixel's surface, and their mean depth and normal.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "screen/far_field/groups_leaf.h"
#include "screen/far_field/far_field_average_io.h"
#include "gpu/view.glsl"

float depth_at(ivec2 p) { return depth[(p.y + view.top) * view.width + p.x + view.left]; }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = ivec2(view.visible_width, view.visible_height);
  if (p.x >= size.x || p.y >= size.y) return;
  const int pixel = p.y * size.x + p.x;
  const float own = depth_at(p);
  const vec3 normal = normals[pixel].xyz;
  const bool parallel = view.orthographic != 0;
  uint mask = 0;
  vec3 sum = vec3(0.0);
  float place = 0.0;
  for (int bit = 0; bit < 9; ++bit) {
    const ivec2 n = p + ivec2(bit % 3, bit / 3) - 1;
    if (any(lessThan(n, ivec2(0))) || any(greaterThanEqual(n, size))) continue;
    const float other = depth_at(n);
    if (!same_depth(own, other)) continue;
    const vec3 m = normals[n.y * size.x + n.x].xyz;
    if (dot(m, normal) <= kLeastCosine && bit != 4) continue;
    mask |= 1u << bit;
    place += parallel ? other : 1.0 / other;
    sum += m;
  }
  const float mean = place / float(max(bitCount(mask), 1));
  const float length_of = length(sum);
  accepted[pixel] = mask;
  groups[pixel] = vec4(length_of > 0.0 ? sum / length_of : normal,
                       mask == 0u ? own : parallel ? mean : 1.0 / mean);
}
