#include "obscura/patterns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double kPi = std::numbers::pi;

template <class Sample>
void expect_whole(std::span<const Sample> samples, int count) {
  ASSERT_EQ(static_cast<int>(samples.size()), count);
  double constant = 0, quadratic = 0;
  for (const Sample& s : samples) {
    double square = static_cast<double>(s.x) * s.x + static_cast<double>(s.y) * s.y;
    if constexpr (requires { s.z; }) square += static_cast<double>(s.z) * s.z;
    EXPECT_LT(square, 1);
    EXPECT_GT(s.weight_constant, 0);
    EXPECT_GT(s.weight_quadratic, 0);
    constant += s.weight_constant;
    quadratic += s.weight_quadratic;
  }
  EXPECT_NEAR(constant, 4 * kPi / 3, 5e-3);
  EXPECT_NEAR(quadratic, 2 * kPi / 15, 5e-4);
}

TEST(Patterns, WeightsSumToTheSphere) {
  for (int n = 1; n <= kMaxDiskSamples; ++n) {
    expect_whole(disk_pattern(n, false), n);
    expect_whole(disk_pattern(n, true), n);
  }
  for (int n = 1; n <= kMaxBallSamples; ++n) expect_whole(ball_pattern(n), n);
}

TEST(Patterns, CenterIsTheCenter) {
  for (int n = 1; n <= kMaxDiskSamples; ++n) {
    EXPECT_EQ(disk_pattern(n, true)[0].x, 0);
    EXPECT_EQ(disk_pattern(n, true)[0].y, 0);
  }
}

// Two samples of the ball that mirror each other share it evenly.
TEST(Patterns, MirroredSamplesWeighTheSame) {
  std::vector<BallSample> ball = {{0.3137f, 0.2071f, -0.1019f, 0, 0},
                                  {-0.3137f, -0.2071f, 0.1019f, 0, 0}};
  weigh(ball);
  EXPECT_NEAR(ball[0].weight_constant, 2 * kPi / 3, 3e-3);
  EXPECT_NEAR(ball[0].weight_constant, ball[1].weight_constant, 5e-3);
  std::vector<DiskSample> disk = {{0.5f, 0, 0, 0}, {-0.5f, 0, 0, 0}};
  weigh(disk);
  EXPECT_NEAR(disk[1].weight_quadratic, kPi / 15, 1e-4);
}

TEST(Patterns, MistakesAreNamed) {
  std::vector<DiskSample> disk = {{1, 2, 3, 4}};
  PatternSettings s;
  s.count = 0;
  EXPECT_EQ(make_disk_pattern(s, &disk).message(), "count is 0; it must be in [1, 256]");
  EXPECT_EQ(disk.size(), 1u);
  s = {};
  s.starts = 0;
  EXPECT_EQ(make_disk_pattern(s, &disk).message(), "starts is 0; it must be in [1, 10000]");
}

}  // namespace
}  // namespace obscura
