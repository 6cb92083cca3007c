#ifndef OBSCURA_REFERENCE_H_
#define OBSCURA_REFERENCE_H_

#include <array>
#include <cstdint>
#include <functional>

#include "obscura/export.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"

namespace obscura {

enum class RayWeighting {
  kCosine,   // ambient obscurance (far-field paper, equation 1)
  kUniform,  // ambient occlusion (bent normals and cones, equation 1)
};
template <>
struct EnumNames<RayWeighting> {
  static constexpr const char* names[] = {"cosine", "uniform"};
};

// The truth that a depth image holds: rays over each pixel's hemisphere, traced without a step size
// against the depth field itself (docs/methods/reference.md says what surface that is). Slow, and
// unbiased: two seeds differ only by the standard error, which can be had as an output. Takes any
// falloff and any occluder.
struct ReferenceSettings {
  Falloff falloff{};
  Occluder occluder = Occluder::automatic();
  int rays = 1024;
  RayWeighting weighting = RayWeighting::kCosine;
  int every = 1;
  bool interpolate = false;
  float beyond_border = 0;
  float offset_px = 0;
  std::uint32_t seed = 1;
  // C++ only: RGB radiance from a unit direction in eye space, for Outputs::radiance. Called from
  // several threads.
  std::function<std::array<float, 3>(const std::array<float, 3>&)> radiance{};
};
template <FieldsOf<ReferenceSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.rays, Field{"rays", "rays per pixel", closed(1, 1 << 20),
                  "Rays per pixel, for each weighting that the outputs need."});
  v(s.weighting, Field{"weighting",
                       "",
                       {},
                       "How directions are weighted: by the cosine to the normal, or equally."});
  v(s.every, Field{"every", "pixels", closed(1, 1000), "Trace only every N-th pixel in x and y."});
  v(s.interpolate,
    Field{"interpolate", "", {}, "Fill the pixels between; otherwise they are NaN."});
  v(s.beyond_border,
    Field{"beyond_border", "world units", at_least(0),
          "Distance behind the image's border at which a ray is blocked; 0: never."});
  v(s.offset_px, Field{"offset_px", "pixels", closed(0, 64),
                       "Distance from the surface at which rays start: towards the camera for "
                       "solid occluders, along the normal for others. 0 chooses 0.001 for solid, 3 "
                       "for thickness, 1 for others."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}
template <>
struct MethodInfo<ReferenceSettings> {
  static constexpr const char* name = "ray-traced";
  static constexpr const char* summary = "Reference: rays against the depth image itself";
  static constexpr const char* page = "docs/methods/reference.md";
  static constexpr bool on_vulkan = false;
  static constexpr bool takes_layers = true;
};

OBSCURA_API Status validate(const ReferenceSettings& settings);

}  // namespace obscura

#endif  // OBSCURA_REFERENCE_H_
