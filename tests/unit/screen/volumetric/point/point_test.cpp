#include "screen/volumetric/point/plan.h"

#include <gtest/gtest.h>

#include "tests/reference/volumetric.h"
#include "tests/unit/screen/volumetric/volumetric_cases.h"

namespace obscura {
namespace {

using namespace volumetric_cases;

// A point is occupied or not; where both sides agree on that, only sums round.
constexpr double kTolerance = 1e-5;
// Of 1960 pixels with 12 points each: samples between two texels or at a surface may fall to either
// side.
constexpr int kAllowed = 12;

TEST(Point, EveryTargetAgreesWithScalar) {
  for (const Case& c : all_cases()) {
    const view::Geometry g = geometry(c);
    PointSettings s = settings_of<PointSettings>(c);
    s.samples = 12;
    std::unique_ptr<Method> method;
    ASSERT_TRUE(make_method(s, g.width, g.height, &method).ok());
    const reference::Point reference(g, s, ball_pattern(s.samples));
    expect_agreement(g, method.get(), reference, 1, kTolerance, kAllowed, c);
  }
}

}  // namespace
}  // namespace obscura
