// What the caller asked for, from the sums over all slices of a pixel (totals.cpp, finish). Before
// this: math/cone_leaf.h, kSums, kOutputs, kPaperCone, kUnsigned, buffer `normals`, gpu/results.glsl.
const float kPi = 3.14159265;

// Sums of a pixel: what totals.h has as channels; directions in eye space.
struct Sums {
  float obscurance, solid;
  vec3 directions;
};

void write_pixel(ivec2 p, vec3 normal, Sums sums) {
  write_visibility(p, clamp(1.0 - sums.obscurance / kPi, 0.0, 1.0));
  if (kSums == 0) return;
  const vec3 integral = normal - sums.directions / kPi;
  const float ambient = 1.0 - sums.solid / (2.0 * kPi);
  const BentCone cone = bent_cone(kPaperCone, integral.x, integral.y, integral.z, 2.0 * ambient,
                                  normal.x, normal.y, normal.z);
  const vec3 bent = vec3(cone.x, cone.y, cone.z);
  write_direction(p, vec4(kUnsigned ? 0.5 * bent + 0.5 : bent, cone.angle / 1.57079633));
}
