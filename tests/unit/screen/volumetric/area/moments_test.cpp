#include "screen/volumetric/area/moments.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "hwy/targets.h"

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

view::Geometry geometry_of(int width, int height, float (*depth)(int, int)) {
  view::Geometry g;
  g.width = width;
  g.height = height;
  g.depth.resize(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) g.depth(x, y) = depth(x, y);
  }
  return g;
}

struct Moments {
  double mean, deviation, share;
};

// With `next`, of the level above at the same place.
Moments texel(const MomentPyramid& p, int level, int x, int y, bool next = false) {
  const int stride = MomentPyramid::row_stride(p.width(), level);
  const auto& t = p.texels()[p.start(level) + static_cast<std::int64_t>(y) * stride + x];
  const std::uint32_t bits = t.deviation_and_share[next];
  return {t.mean[next], std::bit_cast<float>(bits & ~255u), (bits & 255) / 255.0};
}

MomentPyramid pyramid_of(const view::Geometry& g, int threads = 1) {
  MomentPyramid p;
  p.resize(g.width, g.height);
  p.build(g, 0, *make_executor(threads));
  return p;
}

// On a slope the mean is the middle and the deviation that of the kernel, sqrt((4^l - 1) / 3).
TEST(Moments, SlopesHaveTheKernelsDeviation) {
  const view::Geometry g =
      geometry_of(320, 300, [](int x, int y) { return 100 + 0.25f * x - 0.125f * y; });
  const MomentPyramid p = pyramid_of(g);
  ASSERT_GE(p.levels(), 6);
  for (int level = 0; level < 6; ++level) {
    const int shift = MomentPyramid::shift(level), x = 160 >> shift, y = 144 >> shift;
    const Moments m = texel(p, level, x, y);
    const double slope = std::hypot(0.25, 0.125), width = std::sqrt((std::pow(4, level) - 1) / 3);
    EXPECT_NEAR(m.mean, 100 + 0.25 * (x << shift) - 0.125 * (y << shift), 1e-4) << level;
    EXPECT_NEAR(m.deviation, slope * width, 1e-3 * slope * width + 1e-5) << level;
    EXPECT_EQ(m.share, 1) << level;
  }
}

// Half of the image is background: no mean or deviation anywhere knows of it, the shares do.
TEST(Moments, BackgroundDoesNotBleed) {
  const view::Geometry g = geometry_of(200, 100, [](int x, int) { return x < 100 ? 7.0f : kInf; });
  const MomentPyramid p = pyramid_of(g);
  for (int level = 0; level < p.levels(); ++level) {
    const int shift = MomentPyramid::shift(level);
    for (int y = 0; y <= 99 >> shift; ++y) {
      for (int x = 0; x <= 199 >> shift; ++x) {
        const Moments m = texel(p, level, x, y);
        if (m.share > 0) {
          EXPECT_NEAR(m.mean, 7, 1e-5);
        }
        EXPECT_NEAR(m.deviation, 0, 1e-5);
      }
    }
  }
  EXPECT_NEAR(texel(p, 2, 50, 25).share, 0.5, 0.1);
  EXPECT_NEAR(texel(p, 2, 30, 25).share, 1, 1e-6);
  EXPECT_NEAR(texel(p, 2, 70, 25).share, 0, 1e-6);
}

// Depths that differ by a millionth: E[z^2] - E[z]^2 in floats would see nothing or noise.
TEST(Moments, SmallDeviationsAreExact) {
  const view::Geometry g =
      geometry_of(64, 64, [](int x, int y) { return (x + y) % 2 ? 1000.0f : 1000.25f; });
  const Moments m = texel(pyramid_of(g), 2, 15, 15);
  EXPECT_NEAR(m.mean, 1000.125, 1e-3);
  EXPECT_NEAR(m.deviation, 0.125, 1e-4);
}

TEST(Moments, ThreadsAndTargetsAgree) {
  const view::Geometry g = geometry_of(131, 77, [](int x, int y) {
    return x * y % 11 == 0 ? kInf : 5 + std::sin(0.3f * x) * std::cos(0.2f * y);
  });
  const MomentPyramid one = pyramid_of(g, 1), two = pyramid_of(g, 2);
  for (int level = 0; level < one.levels(); ++level) {
    const int shift = MomentPyramid::shift(level);
    for (int y = 0; y <= 76 >> shift; ++y) {
      for (int x = 0; x <= 130 >> shift; ++x) {
        const Moments a = texel(one, level, x, y), b = texel(two, level, x, y);
        EXPECT_EQ(a.mean, b.mean);
        EXPECT_EQ(a.deviation, b.deviation);
      }
    }
  }
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const MomentPyramid p = pyramid_of(g);
    EXPECT_NEAR(texel(p, 4, 10, 5).mean, texel(one, 4, 10, 5).mean, 1e-5);
    EXPECT_NEAR(texel(p, 4, 10, 5).deviation, texel(one, 4, 10, 5).deviation, 1e-4);
  }
  hwy::SetSupportedTargetsForTest(0);
}

// Every texel knows the next level at its own place; where a level keeps every second of the one
// before, both say the same.
TEST(Moments, LevelsAreHeldTwice) {
  const view::Geometry g = geometry_of(131, 77, [](int x, int y) {
    return x < 40 ? kInf : 5 + std::sin(0.3f * x) * std::cos(0.2f * y);
  });
  const MomentPyramid p = pyramid_of(g);
  for (int level = 0; level + 1 < p.levels(); ++level) {
    const int every = 1 << (MomentPyramid::shift(level + 1) - MomentPyramid::shift(level));
    const int shift = MomentPyramid::shift(level + 1);
    for (int y = 0; y <= 76 >> shift; ++y) {
      for (int x = 0; x <= 130 >> shift; ++x) {
        const Moments fine = texel(p, level, every * x, every * y);
        const Moments above = texel(p, level, every * x, every * y, true);
        const Moments next = texel(p, level + 1, x, y);
        EXPECT_EQ(above.share, next.share);
        if (next.share > 0) {
          EXPECT_EQ(above.mean, next.mean);
          EXPECT_EQ(above.deviation, next.deviation);
        }
        // What sees background only borrows.
        if (level == 0 && fine.share == 0) {
          EXPECT_EQ(fine.mean, above.mean);
          EXPECT_EQ(fine.deviation, above.deviation);
        }
      }
    }
  }
}

TEST(Moments, LargestSize) {
  EXPECT_TRUE(MomentPyramid::fits(16000, 16000));
  EXPECT_FALSE(MomentPyramid::fits(65535, 65535));
}

}  // namespace
}  // namespace obscura
