#include "io/pictures/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "io/pictures/plot.h"

namespace obscura::tools {
namespace {

TEST(Pictures, ErrorIsWhiteAtZeroAndBlackFromTwentyPerCent) {
  const std::vector<float> a{0.5f, 0.5f, 0.5f, NAN}, b{0.5f, 0.6f, 0.9f, 0.5f};
  const Image e = error_picture({a.data(), 4, 1}, {b.data(), 4, 1});
  EXPECT_FLOAT_EQ(e.view(0)(0, 0), 1);
  EXPECT_NEAR(e.view(0)(1, 0), 0.5, 1e-5);
  EXPECT_FLOAT_EQ(e.view(0)(2, 0), 0);
  EXPECT_NE(e.view(0)(3, 0), e.view(2)(3, 0));  // unknown has a colour of its own
}

TEST(Pictures, DepthIsWhiteWhereNearestAndBlackInTheBackground) {
  const std::vector<float> d{1, 10, INFINITY};
  const Image p = depth_picture({d.data(), 3, 1});
  EXPECT_FLOAT_EQ(p.view(0)(0, 0), 1);
  EXPECT_NEAR(p.view(0)(1, 0), 0.15, 1e-5);
  EXPECT_EQ(p.view(0)(2, 0), 0);
}

TEST(Pictures, PanelsKeepTheirPixels) {
  const std::vector<float> a{0.25f, 0.5f}, b{0.75f, 1};
  const Image out =
      beside({{"a title", grey_picture({a.data(), 1, 2})}, {"", grey_picture({b.data(), 1, 2})}});
  EXPECT_EQ(out.view(1)(0, out.height - 1), 0.5f);
  EXPECT_EQ(out.view(1)(out.width - 1, out.height - 2), 0.75f);
  const Image two = stack({out, out});
  EXPECT_EQ(two.height, 2 * out.height);
  EXPECT_EQ(two.view(2)(0, two.height - 1), 0.5f);
}

TEST(Plot, LeavesOutWhatALogarithmCannotShow) {
  Plot plot{"t", "x", "y", {{"a<b", {{1, 2}, {0, 1}, {-1, 1}, {10, NAN}}}}};
  const std::string svg = plot.to_svg();
  EXPECT_NE(svg.find("a&lt;b"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ((Plot{"", "", "", {}}).to_svg().find("nan"), std::string::npos);
}

}  // namespace
}  // namespace obscura::tools
