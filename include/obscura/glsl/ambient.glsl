// Ambient light in an engine's own shader, from what vulkan::Recorder writes and the table that
// vulkan::LightRecorder fills. docs/vulkan.md shows a fragment shader; all names begin with
// obscura_, Obscura, light_, Light or kLight. GLSL 4.50; the compiler's include path holds the
// folder of obscura/.
//
// Before the include:
//   #define OBSCURA_LIGHT_TABLE(i) table[i]   vec4 number i of the table
//   #define OBSCURA_LIGHT_CELLS 32            PreconvolutionSettings::cells
#ifndef OBSCURA_GLSL_AMBIENT_GLSL_
#define OBSCURA_GLSL_AMBIENT_GLSL_

// The words of light_leaf.glsl; gone again at the end.
#ifndef LEAF
#define OBSCURA_LEAF_WORDS
#define Real float
#define Truth bool
#define LEAF(type) type
#define LEAF_IN(type) type
#define real(x) (x)
#define leaf_abs abs
#define leaf_sqrt sqrt
#define leaf_floor floor
#define leaf_fma fma
#define leaf_nfma(a, b, c) fma(-(a), b, c)
#define leaf_fms(a, b, c) fma(a, b, -(c))
#define leaf_min min
#define leaf_max max
#define leaf_acos acos
#define leaf_if_negative(x, yes, no) ((x) < 0.0 ? (yes) : (no))
#define leaf_less(a, b) ((a) < (b))
#define leaf_less_equal(a, b) ((a) <= (b))
#define leaf_both(a, b) ((a) && (b))
#define leaf_select(t, yes, no) ((t) ? (yes) : (no))
#endif
#include "obscura/glsl/light_leaf.glsl"

// v / |v|, or `other` where v is zero or not finite.
vec3 obscura_unit(vec3 v, vec3 other) {
  const LightVector u =
      light_unit(LightVector(v.x, v.y, v.z), LightVector(other.x, other.y, other.z));
  return vec3(u.x, u.y, u.z);
}

// Bent normal, a unit vector in eye space, and the half angle of its cone in radians.
struct ObscuraCone {
  vec3 axis;
  float angle;
};

// From a texel of FrameImages::bent_normal as Directions::kSigned; `normal` where it holds none.
ObscuraCone obscura_decode_cone(vec4 texel, vec3 normal) {
  return ObscuraCone(obscura_unit(texel.xyz, normal), light_angle(texel.w * kLightHalfPi));
}
// As Directions::kUnsigned.
ObscuraCone obscura_decode_unsigned_cone(vec4 texel, vec3 normal) {
  return obscura_decode_cone(vec4(2.0 * texel.xyz - 1.0, texel.w), normal);
}

vec3 obscura_vertex(int vertex, float low, float between) {
  const int at = 8 * vertex + int(low);
  return mix(OBSCURA_LIGHT_TABLE(at).xyz, OBSCURA_LIGHT_TABLE(at + 1).xyz, between);
}

// L_c: the radiance of a white diffuse surface that sees the environment through a cone, without
// the sun (obscura/lighting.h). Unit direction in world space, half angle in [0, pi/2].
vec3 obscura_environment(vec3 direction, float angle) {
  const LightCell cell =
      light_cell(float(OBSCURA_LIGHT_CELLS), LightVector(direction.x, direction.y, direction.z));
  const LightLevel level = light_level(angle);
  const int vertex = int(cell.vertex), side = OBSCURA_LIGHT_CELLS + 1;
  const vec3 near = mix(obscura_vertex(vertex, level.low, level.between),
                        obscura_vertex(vertex + 1, level.low, level.between), cell.u);
  const vec3 far = mix(obscura_vertex(vertex + side, level.low, level.between),
                       obscura_vertex(vertex + side + 1, level.low, level.between), cell.u);
  return mix(near, far, cell.v);
}

// Light that a white diffuse surface reflects, with the settings' defaults: cosine-weighted
// visibility times L_c. `world_from_eye` rotates the cone's axis.
vec3 obscura_ambient_light(float visibility, ObscuraCone cone, mat3 world_from_eye) {
  return light_visibility(visibility) *
         obscura_environment(world_from_eye * cone.axis, cone.angle);
}

// The share of a sun's light that reaches a surface, to be multiplied by max(0, n.s) and
// irradiance / pi. Unit normal n and direction s towards the sun, in eye space; radius of its disc
// in radians, above 0.
float obscura_sun_share(float visibility, ObscuraCone cone, vec3 n, vec3 s, float radius) {
  return light_sun_through_cone(false, light_visibility(visibility),
                                clamp(dot(cone.axis, n), 0.0, 1.0), cone.angle,
                                max(cos(cone.angle), 0.0), dot(cone.axis, s), radius);
}

// The share of a specular lobe that is open: how much of the lobe, taken as a cone around the
// reflected direction r, lies in the visibility's cone (Jimenez, Wu, Pesce, Jarabo 2016, "Practical
// real-time strategies for accurate indirect occlusion"; the caps' intersection after
// Oat and Sander 2007, "Ambient aperture lighting"). Unit r in eye space, perceptual roughness in
// [0, 1].
float obscura_specular_occlusion(ObscuraCone cone, vec3 r, float roughness) {
  // The lobe's cone holds 90 % of its energy: cos(a) = 10^(-roughness^2).
  const float lobe = acos(exp2(-3.32192809 * max(roughness * roughness, 1e-4)));
  const float apart = acos(clamp(dot(cone.axis, r), -1.0, 1.0));
  const float narrow = min(lobe, cone.angle), wide = max(lobe, cone.angle);
  const float whole = 1.0 - cos(narrow);
  // 1 where one cone holds the other, 0 where they do not meet.
  const float meet = 1.0 - smoothstep(wide - narrow, wide + narrow, apart);
  return clamp(meet * whole / (1.0 - cos(lobe)), 0.0, 1.0);
}

#ifdef OBSCURA_LEAF_WORDS
#undef OBSCURA_LEAF_WORDS
#undef Real
#undef Truth
#undef LEAF
#undef LEAF_IN
#undef real
#undef leaf_abs
#undef leaf_sqrt
#undef leaf_floor
#undef leaf_fma
#undef leaf_nfma
#undef leaf_fms
#undef leaf_min
#undef leaf_max
#undef leaf_acos
#undef leaf_if_negative
#undef leaf_less
#undef leaf_less_equal
#undef leaf_both
#undef leaf_select
#endif
#endif
