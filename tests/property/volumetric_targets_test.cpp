// Every SIMD target computes the same, in every mode.
#include <gtest/gtest.h>

#include <cmath>

#include "hwy/targets.h"
#include "obscura/obscura.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

// Fused or not, sums differ by rounding; a tap between two texels, or a point sample at a surface,
// may fall to either side.
constexpr float kTolerance = 1e-4f;
constexpr double kShareOffTolerance = 0.004;

template <class Settings>
void expect_targets_agree(Settings s) {
  const synthetic::Input in = synthetic::blocks(95, 71, Camera::perspective(0.8f, 95, 71), 11);
  s.falloff.radius = 0.5f;
  s.blur = false;
  for (int mode = 0; mode < 16; ++mode) {
    DepthField field = in.field();
    field.normal_use = mode & 1 ? NormalUse::kAuto : NormalUse::kNone;
    field.camera.orthographic = (mode & 2) != 0;
    if (field.camera.orthographic) field.camera.scale_x = field.camera.scale_y = 0.05f;
    s.occluder = mode & 4 ? Occluder::of_thickness(0.2f) : Occluder::solid();
    s.falloff.kind = mode & 8 ? FalloffKind::kQuadratic : FalloffKind::kConstant;
    std::vector<float> first;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      std::vector<float> v(95 * 71);
      ASSERT_TRUE(compute(field, s, {.visibility = {v.data(), 95, 71}}).ok());
      if (first.empty()) first = v;
      int different = 0;
      for (std::size_t i = 0; i < v.size(); ++i) {
        different += !(std::abs(v[i] - first[i]) <= kTolerance);
      }
      EXPECT_LE(different, kShareOffTolerance * v.size())
          << hwy::TargetName(target) << ", mode " << mode;
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(VolumetricTargets, Line) { expect_targets_agree(LineSettings{}); }
TEST(VolumetricTargets, Point) { expect_targets_agree(PointSettings{}); }
TEST(VolumetricTargets, Area) { expect_targets_agree(AreaSettings{.samples = 4}); }

}  // namespace
}  // namespace obscura
