#ifndef OBSCURA_OCCLUDER_H_
#define OBSCURA_OCCLUDER_H_

#include "obscura/export.h"
#include "obscura/settings.h"

namespace obscura {

// How thick matter is assumed to be behind each depth sample.
enum class OccluderKind {
  kSolid,      // matter without end: the papers' assumption
  kThickness,  // matter of one thickness along each view ray, between front and back only
  kBackDepth,  // matter down to DepthField::back_depth
  kLayers,     // the first `layers` of DepthField::layers, each between its front and back
  kAuto,       // the best that the depth field says: see Occluder::automatic
};
template <>
struct EnumNames<OccluderKind> {
  static constexpr const char* names[] = {"solid", "thickness", "back-depth", "layers", "auto"};
};

struct Occluder {
  OccluderKind kind = OccluderKind::kSolid;
  static constexpr Range kThicknessRange = positive();  // world units
  static constexpr Range kLayersRange = closed(1, 64);

  float thickness = 0;  // of kThickness
  int layers = 0;       // of kLayers

  static Occluder solid() { return {}; }
  static Occluder of_thickness(float t) { return {OccluderKind::kThickness, t, 0}; }
  static Occluder back_depth() { return {OccluderKind::kBackDepth, 0, 0}; }
  static Occluder of_layers(int k) { return {OccluderKind::kLayers, 0, k}; }
  // Layers where the depth field has them and the method takes them, else the back depth where it
  // is given, else matter as thick as it is wide: a texel's matter ends as far behind its front as
  // the piece of surface that it belongs to is wide in the image, along the row or the column,
  // whichever is less. docs/methods/matter.md says what that is good for.
  static Occluder automatic() { return {OccluderKind::kAuto, 0, 0}; }
};

OBSCURA_API Status validate(const Occluder& occluder);

template <>
struct OBSCURA_API SettingText<Occluder> {
  static std::string form();
  static bool parse(std::string_view text, Occluder* value);
  static std::string write(const Occluder& value);
};

}  // namespace obscura

#endif  // OBSCURA_OCCLUDER_H_
