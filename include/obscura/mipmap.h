#ifndef OBSCURA_MIPMAP_H_
#define OBSCURA_MIPMAP_H_

#include "obscura/falloff.h"
#include "obscura/resolution.h"

namespace obscura {

enum class DepthPyramid {
  kAverage,  // means, read with trilinear interpolation
  kNearest,  // the papers' max-mipmap: the nearest depth, read without interpolation
};
template <>
struct EnumNames<DepthPyramid> {
  static constexpr const char* names[] = {"average", "nearest"};
};

// Ambient obscurance from a depth pyramid (Timonen 2013, section 5): the far
// field's rival, with the same estimator. Along each of K directions the step grows by a factor;
// samples come from the level as wide as the sector; the last one lies at the image's edge. Takes
// any falloff.
struct MipmapSettings {
  Falloff falloff{};
  int directions = 16;
  float step_factor = 1.5f;
  DepthPyramid pyramid = DepthPyramid::kAverage;
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<MipmapSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.directions, Field{"directions", "", closed(4, 64), "Azimuthal directions K."});
  v(s.step_factor, Field{"step_factor", "", closed(1.05, 4),
                         "Factor by which the step grows from sample to sample."});
  v(s.pyramid, Field{"pyramid",
                     "",
                     {},
                     "What a texel of a coarser level holds: the average depth or the nearest."});
  v(s.resolution, resolution_field());
}
template <>
struct MethodInfo<MipmapSettings> {
  static constexpr const char* name = "mipmap";
  static constexpr const char* summary =
      "Ambient obscurance from a depth pyramid, for comparison with the far field";
  static constexpr const char* page = "docs/methods/far-field.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_MIPMAP_H_
