#ifndef OBSCURA_HORIZON_H_
#define OBSCURA_HORIZON_H_

#include <cstdint>

#include "obscura/cone.h"
#include "obscura/falloff.h"
#include "obscura/far_field.h"
#include "obscura/occluder.h"
#include "obscura/resolution.h"

namespace obscura {

enum class HorizonVariant {
  // Half-slices around the receiver's zenith, each with the cosine-weighted integral above its
  // horizon. Matter hangs below each sample away from the camera, without end, as in the solid
  // depth field; what of it lies beyond the falloff's length does not count, what lies within does.
  kSlices,
  // Horizon-based ambient occlusion as published: uniform weights, samples beyond the radius are
  // dropped, each rise of the horizon counts by W(r) = 1 - (r/R)^2. Takes only the radius from the
  // falloff, which must be finite.
  kClassic,
};
template <>
struct EnumNames<HorizonVariant> {
  static constexpr const char* names[] = {"slices", "classic"};
};

// Ambient obscurance from horizons (Bavoil, Sainz, Dimitrov, "Image-space horizon-based ambient
// occlusion", 2008) and its stronger relative: a few samples along each of K directions, which
// m x m neighbouring pixels turn and shift by different parts of a direction and of a step. Both
// give bent normals and cones, the slices also the cosine-weighted integral. Slices take any
// falloff and the occluders auto, solid, thickness and back-depth: where matter has an end, each
// sample covers the sectors of the slice between its front and its back (Therrien, Levesque, Gilet,
// "Screen space indirect lighting with visibility bitmask", 2023). Classic takes matter as solid.
struct HorizonSettings {
  Falloff falloff{};
  Occluder occluder = Occluder::automatic();
  HorizonVariant variant = HorizonVariant::kSlices;
  SlabProfile profile = SlabProfile::kAdaptiveChord;
  int directions = 4;
  int steps = 16;
  float angle_bias = 0.1f;
  int interleave = 4;
  bool blur = true;
  ConeEstimate cone = ConeEstimate::kExact;
  std::uint32_t seed = 1;
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<HorizonSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "With slices: how thick matter is assumed to be behind each depth sample."});
  v(s.variant,
    Field{"variant", "", {}, "Cosine-weighted slices, or the method as published (classic)."});
  v(s.profile, Field{"profile",
                     "",
                     {},
                     "With slices: assumed shape of objects between two visible points, for "
                     "falloffs other than constant."});
  v(s.directions, Field{"directions", "", closed(2, 64), "Azimuthal directions K."});
  v(s.steps, Field{"steps", "per direction", closed(1, 64), "Samples along each direction."});
  v(s.angle_bias,
    Field{"angle_bias", "radians", closed(0, 1.5),
          "With classic: the least angle above the tangent plane at which a sample counts."});
  v(s.interleave, Field{"interleave", "pixels", closed(1, 8),
                        "Groups of m x m pixels share one larger pattern."});
  v(s.blur, Field{"blur", "", {}, "Blur the result, keeping edges."});
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
struct MethodInfo<HorizonSettings> {
  static constexpr const char* name = "horizon";
  static constexpr const char* summary =
      "Horizon-based ambient occlusion (Bavoil 2008) and cosine-weighted slices";
  static constexpr const char* page = "docs/methods/far-field.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_HORIZON_H_
