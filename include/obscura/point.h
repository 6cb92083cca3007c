#ifndef OBSCURA_POINT_H_
#define OBSCURA_POINT_H_

#include <cstdint>

#include "obscura/dual_radius.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"
#include "obscura/resolution.h"

namespace obscura {

// Where point samples lie.
enum class PointPattern {
  kBall,    // in the ball around the receiver, tested for being behind the depth image (Crytek3D)
  kScreen,  // on the disk around the receiver's pixel: the surface point found there occludes if it
            // lies in the sphere and in front of the tangent plane (Crytek2D)
};
template <>
struct EnumNames<PointPattern> {
  static constexpr const char* names[] = {"ball", "screen"};
};

// Volumetric obscurance by point samples (Mittring 2007; Filion and McNaughton 2008; Loos and Sloan
// 2010, section 4). With normals, samples behind the tangent plane are reflected to its front.
// Takes the falloffs constant and quadratic, and the occluders solid and thickness; the screen
// pattern takes solid alone.
struct PointSettings {
  Falloff falloff{.kind = FalloffKind::kConstant};
  DualRadius dual{};
  Occluder occluder{};
  PointPattern pattern = PointPattern::kBall;
  int samples = 12;
  bool rotate = true;
  bool blur = true;
  std::uint32_t seed = 1;
  Resolution resolution = Resolution::kFull;
};
template <FieldsOf<PointSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  visit_fields(s.dual, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.pattern,
    Field{"pattern", "", {}, "Test points in the ball, or surface points found on the screen."});
  v(s.samples,
    Field{"samples", "per pixel", closed(1, 64), "Samples in the pattern; up to 32 with screen."});
  v(s.rotate, Field{"rotate", "", {}, "Reflect the pattern at random in each pixel."});
  v(s.blur, Field{"blur", "", {}, "Blur the result, keeping edges."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
  v(s.resolution, resolution_field());
}
template <>
struct MethodInfo<PointSettings> {
  static constexpr const char* name = "point";
  static constexpr const char* summary = "Volumetric obscurance by point samples (Mittring 2007)";
  static constexpr const char* page = "docs/methods/volumetric-obscurance.md";
  static constexpr bool on_vulkan = true;
};

}  // namespace obscura

#endif  // OBSCURA_POINT_H_
