#include "view/widths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace obscura::view {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

class WidthsTest : public testing::Test {
 protected:
  // Depth of pixel (x, y) as `depth` gives it; the pixel is `scale` wide at depth 1.
  template <class Depth>
  void fill(int width, int height, float scale, bool parallel, Depth depth) {
    g_.width = width;
    g_.height = height;
    g_.camera.scale_x = scale;
    g_.camera.scale_y = 2 * scale;
    g_.camera.orthographic = parallel;
    g_.depth.resize(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) g_.depth(x, y) = depth(x, y);
    }
    back_from_widths(*executor_, &g_);
  }
  float thickness(int x, int y) const { return g_.back_depth(x, y) - g_.depth(x, y); }

  std::unique_ptr<Executor> executor_ = make_executor(2);
  Geometry g_;
};

TEST_F(WidthsTest, APostIsAsThickAsItIsWide) {
  for (bool parallel : {false, true}) {
    const auto post = [](int x, int) { return x >= 10 && x < 17 ? 2.0f : 8.0f; };
    fill(90, 40, 0.01f, parallel, post);
    EXPECT_NEAR(thickness(12, 20), 7 * 0.01f * (parallel ? 1 : 2), 1e-5);
    // A lying one, by the larger size of a pixel down the image.
    fill(90, 40, 0.01f, parallel, [&](int x, int y) { return post(y, x); });
    EXPECT_NEAR(thickness(45, 12), 7 * 0.02f * (parallel ? 1 : 2), 1e-5);
  }
}

TEST_F(WidthsTest, BackgroundPartsAndHasNoMatter) {
  fill(64, 64, 0.01f, false, [](int x, int) { return x % 8 < 3 ? 1.0f : kInf; });
  EXPECT_NEAR(thickness(1, 30), 0.03f, 1e-6);
  EXPECT_EQ(g_.back_depth(5, 30), kInf);
}

// Two ways: the chains from both sides, and products of what joins all texels between two.
TEST_F(WidthsTest, RunsAreSumsOfProducts) {
  Random random(3);
  fill(37, 1, 0.01f, true,
       [&](int, int) { return 3 + 0.12f * static_cast<float>(random.uniform()); });
  auto joined = [&](int x) {
    const float steps = std::abs(g_.depth(x, 0) - g_.depth(x + 1, 0)) / 0.01f;
    return std::clamp((10 - steps) / 4, 0.0f, 1.0f);
  };
  for (int x = 0; x < 37; ++x) {
    double run = 1;
    double part = 1;
    for (int i = x; i + 1 < 37; ++i) run += part *= joined(i);
    part = 1;
    for (int i = x; i > 0; --i) run += part *= joined(i - 1);
    EXPECT_NEAR(g_.runs(x, 0), run, 1e-4 * run) << x;
  }
}

// Depths that change a little change the thickness a little, also where a piece comes apart.
TEST_F(WidthsTest, NothingJumps) {
  float last = -1;
  for (int i = 0; i <= 400; ++i) {
    const float gap = 0.02f + 1e-3f * static_cast<float>(i);  // 1 to 21 footprints
    fill(80, 80, 0.01f, false, [&](int x, int) { return x < 40 ? 2.0f : 2.0f + gap; });
    const float here = thickness(10, 40);
    if (last >= 0) {
      EXPECT_LT(std::abs(here - last), 0.02f * last) << gap;
    }
    last = here;
  }
  EXPECT_NEAR(last, 40 * 0.02f, 1e-4);
}

// A post that moves out of the image loses a footprint for each pixel, and nothing at once.
TEST_F(WidthsTest, NothingJumpsAtTheBorder) {
  float last = 12 * 0.02f;
  for (int first = 20; first > -11; --first) {
    fill(80, 60, 0.01f, false,
         [&](int x, int) { return x >= first && x < first + 12 ? 2.0f : 8.0f; });
    const float here = thickness(std::max(first, 0), 30);
    EXPECT_GE(here, last - 0.02f - 1e-5f) << first;
    EXPECT_LE(here, last + 1e-5f) << first;
    last = here;
  }
  EXPECT_NEAR(last, 2 * 0.02f, 1e-5);
}

}  // namespace
}  // namespace obscura::view
