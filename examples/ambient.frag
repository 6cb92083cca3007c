// A fragment shader of one's own that lights with obscura/glsl/ambient.glsl: diffuse light through
// the bent cone, the sun, and a reflection that the cone occludes. docs/vulkan.md says what to bind.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

layout(binding = 0) uniform texture2D visibility_image;
layout(binding = 1) uniform texture2D bent_normal_image;  // Directions::kSigned
layout(binding = 2) uniform texture2D albedo_image;
layout(binding = 3) readonly buffer Light { vec4 light_table[]; };  // LightRecorder's memory
layout(push_constant) uniform View {
  mat3 world_from_eye;
  vec4 sun;      // direction in eye space, and the radius of its disc in radians
  vec4 sun_rgb;  // irradiance / pi, and the surface's roughness
} view;

#define OBSCURA_LIGHT_TABLE(i) light_table[i]
#define OBSCURA_LIGHT_CELLS 32
#include "obscura/glsl/ambient.glsl"

layout(location = 0) in vec3 eye_position;
layout(location = 1) in vec3 eye_normal;
layout(location = 0) out vec4 colour;

void main() {
  const ivec2 p = ivec2(gl_FragCoord.xy);
  const vec3 n = normalize(eye_normal);
  const float visibility = texelFetch(visibility_image, p, 0).x;
  const ObscuraCone cone = obscura_decode_cone(texelFetch(bent_normal_image, p, 0), n);
  vec3 light = obscura_ambient_light(visibility, cone, view.world_from_eye);
  light += max(dot(n, view.sun.xyz), 0.0) * view.sun_rgb.xyz *
           obscura_sun_share(visibility, cone, n, view.sun.xyz, view.sun.w);
  const vec3 r = reflect(normalize(eye_position), n);
  const float roughness = view.sun_rgb.w;
  const vec3 mirrored = obscura_environment(normalize(view.world_from_eye * r), roughness) *
                        obscura_specular_occlusion(cone, r, roughness);
  colour = vec4(texelFetch(albedo_image, p, 0).xyz * light + 0.04 * mirrored, 1.0);
}
