#include "tests/conformance/vulkan_fixture.h"

namespace obscura {
namespace {

using VulkanHorizon = VulkanTest;

HorizonSettings horizon(float radius) {
  HorizonSettings s;
  s.falloff.radius = radius;
  return s;
}

synthetic::Input scene(int width, int height, std::uint64_t seed, bool orthographic = false) {
  return synthetic::blocks(width, height,
                           orthographic ? Camera::orthographic_height(4, width, height)
                                        : Camera::perspective(1, width, height),
                           seed);
}

TEST_F(VulkanHorizon, SlicesAgreeForEveryFalloffAndProfile) {
  const synthetic::Input in = scene(96, 64, 3);
  for (FalloffKind kind : {FalloffKind::kConstant, FalloffKind::kExponential,
                           FalloffKind::kQuadratic, FalloffKind::kInverseSquare}) {
    for (SlabProfile profile : {SlabProfile::kSlab, SlabProfile::kAdaptiveChord}) {
      HorizonSettings s = horizon(0.7f);
      s.falloff.kind = kind;
      s.profile = profile;
      s.blur = false;
      const std::string what =
          "kind " + std::to_string(int(kind)) + " profile " + std::to_string(int(profile));
      expect_same(in.field(), s, what);
      expect_same(in.field(), s, what + " directions", true);
    }
  }
}

}  // namespace
}  // namespace obscura
