// What the caller asked for, from the sums over all slices of a pixel (totals.cpp, finish). Before
// this: kSums, kOutputs, kPaperCone, kUnsigned, buffer `normals`, gpu/results.glsl.
const float kPi = 3.14159265;

// Sums of a pixel: what totals.h has as channels; directions in eye space.
struct Sums {
  float obscurance, solid;
  vec3 directions;
};

float cone_angle(float mean_length) {
  const float c = clamp(2.0 * mean_length - 1.0, 0.0, 1.0);
  return kPaperCone ? (1.0 - c) * 1.57079633 : fast_acos(c);
}

void write_pixel(ivec2 p, vec3 normal, Sums sums) {
  write_visibility(p, clamp(1.0 - sums.obscurance / kPi, 0.0, 1.0));
  if (kSums == 0) return;
  const vec3 integral = normal - sums.directions / kPi;
  const float length_of = length(integral), ambient = 1.0 - sums.solid / (2.0 * kPi);
  // Where next to nothing is open its direction is noise.
  const bool open = length_of > 1e-3;
  const vec3 bent = open ? integral / length_of : normal;
  const float mean = ambient > 0.0 ? length_of / (2.0 * ambient) : 0.5;
  const float angle = open ? cone_angle(mean) : 0.0;
  write_direction(p, vec4(kUnsigned ? 0.5 * bent + 0.5 : bent, angle / 1.57079633));
}
