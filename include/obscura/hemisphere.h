#ifndef OBSCURA_HEMISPHERE_H_
#define OBSCURA_HEMISPHERE_H_

#include <array>
#include <cstdint>
#include <functional>

#include "obscura/cone.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"
#include "obscura/reference.h"
#include "obscura/resolution.h"

namespace obscura {

// Directions over the hemisphere, each tested at a few points in depth (Crytek3D of bent normals
// and cones, Klehm et al. 2011, section 4): visibility, bent normal and cone from the same samples.
// The pattern is interleaved: m x m neighbours use different directions and offsets, and a blur of
// that size, which works on the difference between bent normal and normal, puts them together.
// Takes the falloffs constant and quadratic, and the occluders auto, solid,
// thickness and back-depth.
struct HemisphereSettings {
  Falloff falloff{.kind = FalloffKind::kConstant};
  Occluder occluder{};
  int samples = 8;
  int steps = 3;
  int interleave = 4;
  bool blur = true;
  RayWeighting weighting = RayWeighting::kCosine;
  ConeEstimate cone = ConeEstimate::kExact;
  std::uint32_t seed = 1;
  // C++ only: RGB radiance from a unit direction in eye space. Each direction then gathers its own
  // light into Outputs::radiance: screen-space directional occlusion (Ritschel, Grosch, Seidel
  // 2009). Called once per estimator, at the directions of a table; 1/samples of the hemisphere is
  // what one sample stands for, so light that is blurred by as much gives the least noise.
  std::function<std::array<float, 3>(const std::array<float, 3>&)> radiance{};
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<HemisphereSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.samples, Field{"samples", "per pixel", closed(1, 64), "Samples in the pattern."});
  v(s.steps,
    Field{"steps", "per sample", closed(0, 8), "Points tested between the pixel and each sample."});
  v(s.interleave, Field{"interleave", "pixels", closed(1, 8),
                        "Groups of m x m pixels share one larger pattern."});
  v(s.blur, Field{"blur", "", {}, "Blur the result, keeping edges."});
  v(s.weighting,
    Field{"weighting",
          "",
          {},
          "How directions are weighted: by the cosine to the normal, or equally as in the paper."});
  v(s.cone,
    Field{
        "cone",
        "",
        {},
        "How the cone angle follows from the mean direction: exactly for a cap, or as published."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
  v(s.resolution, resolution_field());
}
template <>
struct MethodInfo<HemisphereSettings> {
  static constexpr const char* name = "hemisphere";
  static constexpr const char* summary =
      "Directions marched in depth: bent normals and cones (Klehm et al. 2011)";
  static constexpr const char* page = "docs/methods/bent-normals-and-cones.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_HEMISPHERE_H_
