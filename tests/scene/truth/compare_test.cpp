#include "scene/truth/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace obscura::tools {
namespace {

TEST(Compare, KnownDifferences) {
  const std::vector<float> a{0.5f, 0.5f, 0.54f, 0.9f}, b{0.5f, 0.6f, 0.5f, 0.5f};
  Comparison c;
  ASSERT_TRUE(compare({a.data(), 2, 2}, {b.data(), 2, 2}, {}, &c).ok());
  EXPECT_EQ(c.pixels, 4);
  EXPECT_NEAR(c.e_a, 100 * (0.1 + 0.04 + 0.4) / 4, 1e-5);
  EXPECT_NEAR(c.bias, 100 * (-0.1 + 0.04 + 0.4) / 4, 1e-5);
  EXPECT_NEAR(c.within_5, 50, 1e-9);
  EXPECT_NEAR(c.maximum, 40, 1e-5);
  EXPECT_NEAR(c.rmse, 100 * std::sqrt((0.01 + 0.0016 + 0.16) / 4), 1e-5);
}

TEST(Compare, SubsetReadsTheMiddleOfEachBlock) {
  std::vector<float> a(10 * 5, 0.0f);
  a[2 * 10 + 2] = 0.25f;
  a[2 * 10 + 7] = 0.75f;
  const std::vector<float> b{0.25f, 0.75f};
  Comparison c;
  ASSERT_TRUE(compare({a.data(), 10, 5}, {b.data(), 2, 1}, {}, &c).ok());
  EXPECT_EQ(c.e_a, 0);
  EXPECT_NEAR(c.correlation, 1, 1e-12);
}

TEST(Compare, LeavesOutNanAndBackground) {
  const float nan = std::nanf(""), inf = INFINITY;
  const std::vector<float> a{1, nan, 0.5f, 0.2f}, b{1, 0.5f, nan, 0.9f}, mask{1, 1, 1, inf};
  Comparison c;
  ASSERT_TRUE(compare({a.data(), 4, 1}, {b.data(), 4, 1}, {mask.data(), 4, 1}, &c).ok());
  EXPECT_EQ(c.pixels, 1);
  EXPECT_EQ(c.e_a, 0);
  EXPECT_EQ(c.nan, 2);
  EXPECT_EQ(c.nan_image, 1);
  EXPECT_EQ(c.nan_reference, 1);
}

TEST(Compare, SaysWhyNoPixelIsLeft) {
  const float nan = std::nanf(""), inf = INFINITY;
  const std::vector<float> a{nan, inf}, b{nan, 0};
  Comparison c;
  const Status s = compare({a.data(), 2, 1}, {b.data(), 2, 1}, {}, &c);
  ASSERT_FALSE(s.ok());
  EXPECT_NE(std::string(s.message()).find("1 are NaN"), std::string::npos) << s.message();
  EXPECT_EQ(c.nan, 1);
  EXPECT_EQ(c.infinite, 1);
}

TEST(Compare, RefusesSizesThatDoNotFit) {
  const std::vector<float> a(12), b(4);
  Comparison c;
  EXPECT_FALSE(compare({a.data(), 4, 3}, {b.data(), 2, 2}, {}, &c).ok());
  EXPECT_FALSE(compare({a.data(), 4, 3}, {a.data(), 4, 3}, {b.data(), 2, 2}, &c).ok());
}

}  // namespace
}  // namespace obscura::tools
