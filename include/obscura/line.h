#ifndef OBSCURA_LINE_H_
#define OBSCURA_LINE_H_

#include <cstdint>

#include "obscura/dual_radius.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"
#include "obscura/resolution.h"

namespace obscura {

// Which sphere is integrated over.
enum class SphereKind {
  kCentered,  // around the receiver; with normals the half in front of the tangent plane
  kTangent,   // of half the radius, touching the tangent plane (Szirmay-Kalos et al. 2009): what
              // lies along the normal counts more, as under a cosine; needs normals
};
template <>
struct EnumNames<SphereKind> {
  static constexpr const char* names[] = {"centered", "tangent"};
};

// Volumetric obscurance by line samples (Loos and Sloan 2010, section 4.1): the share of a sphere
// around the receiver that is free of matter, from lines along the view direction. With normals
// only the half in front of the tangent plane counts, so that a plane of any tilt gives 1. Takes
// the falloffs constant and quadratic, and the occluders solid and thickness.
struct LineSettings {
  Falloff falloff{.kind = FalloffKind::kConstant};
  DualRadius dual{};
  Occluder occluder{};
  SphereKind sphere = SphereKind::kCentered;
  int samples = 9;
  bool center = false;
  bool rotate = true;
  bool blur = true;
  std::uint32_t seed = 1;
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<LineSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  visit_fields(s.dual, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.sphere,
    Field{"sphere", "", {}, "Sphere around the point, or in front of its tangent plane."});
  v(s.samples, Field{"samples", "per pixel", closed(1, 32), "Samples in the pattern."});
  v(s.center, Field{"center", "", {}, "Put one sample at the centre of the pattern."});
  v(s.rotate, Field{"rotate", "", {}, "Reflect the pattern at random in each pixel."});
  v(s.blur, Field{"blur", "", {}, "Blur the result, keeping edges."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
  v(s.resolution, resolution_field());
}
template <>
struct MethodInfo<LineSettings> {
  static constexpr const char* name = "line";
  static constexpr const char* summary =
      "Volumetric obscurance by line samples (Loos and Sloan 2010)";
  static constexpr const char* page = "docs/methods/volumetric-obscurance.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_LINE_H_
