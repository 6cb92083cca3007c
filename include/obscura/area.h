#ifndef OBSCURA_AREA_H_
#define OBSCURA_AREA_H_

#include <cstdint>

#include "obscura/dual_radius.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"
#include "obscura/resolution.h"

namespace obscura {

// Volumetric obscurance by area samples (Loos and Sloan 2010, section 4.2): the mean and deviation
// of the depths over each sample's share of the disk, from a pyramid of moments, stand for the
// depths themselves, as a box of half-width one deviation around the mean. Takes the falloffs
// constant and quadratic, and the occluders solid and thickness.
struct AreaSettings {
  Falloff falloff{.kind = FalloffKind::kConstant};
  DualRadius dual{};
  Occluder occluder{};
  int samples = 1;
  bool center = false;
  bool rotate = true;
  bool blur = true;
  std::uint32_t seed = 1;
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<AreaSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  visit_fields(s.dual, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.samples, Field{"samples", "per pixel", closed(1, 16), "Samples in the pattern."});
  v(s.center, Field{"center", "", {}, "Put one sample at the centre of the pattern."});
  v(s.rotate, Field{"rotate", "", {}, "Reflect the pattern at random in each pixel."});
  v(s.blur, Field{"blur", "", {}, "Blur the result, keeping edges."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
  v(s.resolution, resolution_field());
}
template <>
struct MethodInfo<AreaSettings> {
  static constexpr const char* name = "area";
  static constexpr const char* summary =
      "Volumetric obscurance by area samples (Loos and Sloan 2010)";
  static constexpr const char* page = "docs/methods/volumetric-obscurance.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_AREA_H_
