#include "screen/volumetric/area/plan.h"

#include <gtest/gtest.h>

#include "screen/volumetric/area/moments.h"
#include "tests/reference/area.h"
#include "tests/unit/screen/volumetric/volumetric_cases.h"

namespace obscura {
namespace {

using namespace volumetric_cases;

// Shares of surface are kept in 8 bits, and the tangent plane's bend under a kernel to first order.
constexpr double kTolerance = 5e-3;
// Of 130 pixels: at a level's end both sides may round to other texels.
constexpr int kAllowed = 3;

TEST(Area, EveryTargetAgreesWithScalar) {
  MomentPyramid pyramid;
  pyramid.resize(kWidth, kHeight);
  for (const Case& c : all_cases()) {
    const view::Geometry g = geometry(c);
    AreaSettings s = settings_of<AreaSettings>(c);
    s.samples = 4;
    std::unique_ptr<Method> method;
    ASSERT_TRUE(make_method(s, kWidth, kHeight, &method).ok());
    const reference::Area reference(g, s, disk_pattern(s.samples, s.center), pyramid.levels());
    expect_agreement(g, method.get(), reference, 4, kTolerance, kAllowed, c);
  }
}

// Away from the border, under kernels that are wider than what that image has room for.
TEST(Area, CoarseLevelsAgreeWithScalar) {
  const int width = 241, height = 230;
  MomentPyramid pyramid;
  pyramid.resize(width, height);
  for (const bool normals : {false, true}) {
    const Case c{.normals = normals,
                 .rotate = true,
                 .thickness = normals,
                 .quadratic = false,
                 .orthographic = normals};
    const view::Geometry g = geometry(c, width, height);
    for (const int samples : {1, 9}) {
      auto s = settings_of<AreaSettings>(c);
      s.samples = samples;
      s.falloff.radius = 2;
      std::unique_ptr<Method> method;
      ASSERT_TRUE(make_method(s, width, height, &method).ok());
      const reference::Area reference(g, s, disk_pattern(samples, s.center), pyramid.levels());
      expect_agreement(g, method.get(), reference, 29, kTolerance, kAllowed, c);
    }
  }
}

}  // namespace
}  // namespace obscura
