// Light of each pixel through its visibility, bent normal and cone: light_simd.cpp in GLSL.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "math/leaf_glsl.h"
#include "math/slab_leaf.h"
#define leaf_acos fast_acos
#include "lighting/light_io.h"
#define OBSCURA_LIGHT_TABLE(i) light_table[i]
#define OBSCURA_LIGHT_CELLS kCells
#include "obscura/glsl/ambient.glsl"

const int kAmbientOcclusion = 0, kBentCone = 2;

vec3 to_world(vec3 v) {
  return vec3(dot(vec3(view.xx, view.xy, view.xz), v), dot(vec3(view.yx, view.yy, view.yz), v),
              dot(vec3(view.zx, view.zy, view.zz), v));
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= view.visible_width || p.y >= view.visible_height) return;
  const float visibility = light_visibility(texelFetch(visibility_image, p, 0).x);
  const vec3 n = obscura_unit(texelFetch(normal_image, p + ivec2(view.left, view.top), 0).xyz,
                              vec3(0.0, 0.0, 1.0));
  ObscuraCone cone = ObscuraCone(n, kLightHalfPi);
  if (kTechnique != kAmbientOcclusion) {
    const vec4 texel = texelFetch(direction_image, p, 0);
    cone = kUnsigned ? obscura_decode_unsigned_cone(texel, n) : obscura_decode_cone(texel, n);
  }
  if (kTechnique != kBentCone) cone.angle = kLightHalfPi;

  const float cosine = kTechnique == kBentCone ? max(cos(cone.angle), 0.0) : 0.0;
  const float bend = clamp(dot(cone.axis, n), 0.0, 1.0);
  vec3 light = obscura_environment(to_world(cone.axis), cone.angle) *
               light_scale(kGeometricTerm, kPaper && kTechnique == kBentCone, visibility, bend,
                           cosine);

  const vec3 sun = vec3(view.sun_x, view.sun_y, view.sun_z);
  const vec3 sun_light = vec3(view.sun_red, view.sun_green, view.sun_blue);
  float facing = max(dot(cone.axis, sun), 0.0) * visibility;
  if (kTechnique == kBentCone) {
    facing = max(dot(n, sun), 0.0) *
             light_sun_through_cone(kUniformWeights, visibility, bend, cone.angle, cosine,
                                    dot(cone.axis, sun), view.sun_radius);
  }
  light += facing * sun_light;
  if (kAlbedo) light *= max(texelFetch(albedo_image, p + ivec2(view.left, view.top), 0).xyz, 0.0);
  imageStore(light_result, p, vec4(light, 1.0));
}
