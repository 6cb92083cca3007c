#ifndef OBSCURA_LINE_H_
#define OBSCURA_LINE_H_

#include <cstdint>

#include "obscura/falloff.h"
#include "obscura/occluder.h"

namespace obscura {

// Volumetric obscurance by line samples (Loos and Sloan 2010, section 4.1): the share of a sphere
// around the receiver that is free of matter, from lines along the view direction. With normals
// only the half in front of the tangent plane counts, so that a plane of any tilt gives 1.
struct LineSettings {
  Falloff falloff{.kind = FalloffKind::kConstant};  // constant or quadratic; radius: the sphere's
  Occluder occluder{};                              // solid or thickness
  int samples = 9;                                  // [1, 32] lines per pixel
  bool rotate = true;                               // random reflection of the pattern per pixel
  bool blur = true;                                 // edge-aware separable blur of the result
  std::uint32_t seed = 1;                           // of the random reflections
};
template <FieldsOf<LineSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.occluder, Field{"occluder", "world units", {}, "What lies behind the first surface."});
  v(s.samples, Field{"samples", "lines per pixel", closed(1, 32), "Size of the pattern."});
  v(s.rotate, Field{"rotate", "", {}, "Reflect the pattern at random per pixel."});
  v(s.blur, Field{"blur", "", {}, "Edge-aware blur of the result."});
  v(s.seed, Field{"seed", "", anything(), "Seed of everything random."});
}

}  // namespace obscura

#endif  // OBSCURA_LINE_H_
