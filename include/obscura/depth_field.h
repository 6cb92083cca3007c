#ifndef OBSCURA_DEPTH_FIELD_H_
#define OBSCURA_DEPTH_FIELD_H_

#include <limits>
#include <span>

#include "obscura/camera.h"
#include "obscura/settings.h"
#include "obscura/views.h"

namespace obscura {

enum class DepthKind {
  kLinear,       // eye-space -z in world units
  kDistance,     // along the pixel's ray, in world units
  kNdc,          // 0 at the near plane, 1 at the far plane
  kNdcReversed,  // 1 at the near plane, 0 at the far plane
};

template <>
struct EnumNames<DepthKind> {
  static constexpr const char* names[] = {"linear", "distance", "ndc", "ndc-reversed"};
};

enum class NormalUse {
  kAuto,  // the normals given, or reconstructed from depth where none are
  kNone,  // the estimator works without normals (volumetric obscurance only)
};

// One depth layer: matter fills each pixel's ray from `front` to `back` (values of the same kind
// as the depth image; no surface: +inf, NaN or far in front).
struct DepthLayer {
  ImageView<const float> front;
  ImageView<const float> back;
};

// Linear depth that no scene has, in any unit: renderers write 1e10, 1e30 or 3.4e38 for "nothing".
inline constexpr float kNoDepth = 1e9f;

// What a renderer hands over. The views stay the caller's and are read during the call only.
//
// Depth is positive; +inf, NaN, anything at or beyond the far plane and linear depths of kNoDepth
// and beyond are background, which occludes nothing and receives nothing (its visibility is 1). A
// depth that is zero, negative or -inf is refused with its pixel's coordinates.
struct DepthField {
  ImageView<const float> depth{};  // whole image, guard band included; 1..65535 px a side
  DepthKind depth_kind = DepthKind::kLinear;
  float near_plane = 0;                                      // for the NDC kinds: (0, far_plane)
  float far_plane = std::numeric_limits<float>::infinity();  // background starts here
  Camera camera{};
  GuardBand guard_band{};

  // Optional; same size as depth. Eye space, +z towards the camera; they need not be unit.
  VectorView<const float> normals{};
  NormalUse normal_use = NormalUse::kAuto;

  ImageView<const float> back_depth{};   // optional: where the first layer's matter ends
  std::span<const DepthLayer> layers{};  // optional: nearest first, for the `layers` occluder

  Extent visible() const { return guard_band.inside({depth.width, depth.height}); }
};

}  // namespace obscura

#endif  // OBSCURA_DEPTH_FIELD_H_
