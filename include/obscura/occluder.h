#ifndef OBSCURA_OCCLUDER_H_
#define OBSCURA_OCCLUDER_H_

#include "obscura/settings.h"

namespace obscura {

// What lies behind the first surface of a depth image.
enum class OccluderKind {
  kSolid,      // matter without end: the papers' assumption
  kThickness,  // matter of one thickness along each view ray, between front and back only
  kBackDepth,  // matter down to DepthField::back_depth
  kLayers,     // the first `layers` of DepthField::layers, each between its front and back
};
template <>
struct EnumNames<OccluderKind> {
  static constexpr const char* names[] = {"solid", "thickness", "back-depth", "layers"};
};

struct Occluder {
  OccluderKind kind = OccluderKind::kSolid;
  float thickness = 0;  // kThickness: world units, (0, inf)
  int layers = 0;       // kLayers: 1..64

  static Occluder solid() { return {}; }
  static Occluder of_thickness(float t) { return {OccluderKind::kThickness, t, 0}; }
  static Occluder back_depth() { return {OccluderKind::kBackDepth, 0, 0}; }
  static Occluder of_layers(int k) { return {OccluderKind::kLayers, 0, k}; }
};

Status validate(const Occluder& occluder);

template <>
struct SettingText<Occluder> {
  static constexpr const char* form =
      "solid, thickness:T with T in (0, inf), back-depth or layers:K with K in [1, 64]";
  static bool parse(std::string_view text, Occluder* value);
  static std::string write(const Occluder& value);
};

}  // namespace obscura

#endif  // OBSCURA_OCCLUDER_H_
