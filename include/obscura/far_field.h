#ifndef OBSCURA_FAR_FIELD_H_
#define OBSCURA_FAR_FIELD_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "obscura/cone.h"
#include "obscura/export.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"
#include "obscura/resolution.h"

namespace obscura {

// Where matter is between two points that an azimuthal slice has seen.
enum class SlabProfile {
  kSlab,           // the paper: each point's matter begins at its own view ray
  kAdaptiveChord,  // on the line from the point before, where that one was visible too
};
template <>
struct EnumNames<SlabProfile> {
  static constexpr const char* names[] = {"slab", "adaptive-chord"};
};

// Points on the measured front of error against time; see docs/methods/far-field.md.
enum class FarFieldPreset { kNone, kFast, kBalanced, kHigh };
template <>
struct EnumNames<FarFieldPreset> {
  static constexpr const char* names[] = {"none", "fast", "balanced", "high"};
};

// Distance between the direct samples of the near field.
struct NearStep {
  static constexpr Range kRange = closed(0.125, 8);
  float px = 0;  // in kRange, or 0: adaptive, where texels are crossed

  static NearStep adaptive() { return {}; }
  static NearStep of(float px) { return {px}; }
  bool operator==(const NearStep&) const = default;
};
template <>
struct OBSCURA_API SettingText<NearStep> {
  static std::string form() {
    return "adaptive or a number of pixels in " + to_string(NearStep::kRange);
  }
  static bool parse(std::string_view text, NearStep* value);
  static std::string write(const NearStep& value);
};

// Far-field ambient obscurance (Timonen 2013): the whole depth image for every pixel at a cost that
// does not depend on the radius. Lines scanned in K directions leave per interval the highest
// geometry as seen at two slopes; each receiver reads their averages over its azimuthal sector.
// Direct samples serve the first one and a half intervals. Takes any falloff, and the occluders
// auto, solid, thickness and back-depth.
struct FarFieldSettings {
  Falloff falloff{};
  Occluder occluder = Occluder::automatic();
  FarFieldPreset preset = FarFieldPreset::kNone;
  int directions = 16;
  int segments = 2;
  int interval = 10;
  SlabProfile profile = SlabProfile::kAdaptiveChord;
  int receiver_slope = 1;
  NearStep near_step{};
  bool near_field = true;
  int separable = 1;
  bool jitter = false;
  bool blur = true;
  int line_step = 1;
  ConeEstimate cone = ConeEstimate::kExact;
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<FarFieldSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.preset, Field{"preset", "", {}, "Overrides directions, segments, near_step and separable."});
  v(s.directions,
    Field{"directions", "", closed(4, 64), "Directions K in which the depth image is scanned."});
  v(s.segments, Field{"segments", "per direction", closed(1, 8), "Sectors S per direction."});
  v(s.interval, Field{"interval", "pixels", closed(2, 64),
                      "Length B0 of the shortest interval along a scanned line."});
  v(s.profile,
    Field{"profile",
          "",
          {},
          "Assumed shape of objects between two visible points of a slice; slab is the paper's."});
  v(s.receiver_slope,
    Field{"receiver_slope", "", closed(-1, 1),
          "Slope of the second line of sight to an interval: 1, or -1 as published."});
  v(s.near_step, Field{"near_step",
                       "pixels",
                       {},
                       "Distance between samples near the pixel, with solid occluders; others are "
                       "sampled row by row."});
  v(s.near_field, Field{"near_field", "", {}, "Sample the pixel's surroundings directly, too."});
  v(s.separable, Field{"separable", "pixels", closed(1, 3),
                       "n: each pixel of an n x n group evaluates 1/n^2 of the directions, whose "
                       "number must be a multiple of n^2."});
  v(s.jitter, Field{"jitter", "", {}, "Rotates sectors per pixel, in groups of 3x3 pixels."});
  v(s.blur, Field{"blur", "", {}, "5x5 edge-aware blur; used with jitter."});
  v(s.line_step, Field{"line_step", "pixels", closed(1, 4), "Scan every n-th line only."});
  v(s.cone,
    Field{
        "cone",
        "",
        {},
        "How the cone angle follows from the mean direction: exactly for a cap, or as published."});
  v(s.resolution, resolution_field());
}
template <>
struct MethodInfo<FarFieldSettings> {
  static constexpr const char* name = "far-field";
  static constexpr const char* summary =
      "Far-field ambient obscurance: every pixel sees the whole depth image (Timonen 2013)";
  static constexpr const char* page = "docs/methods/far-field.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_FAR_FIELD_H_
