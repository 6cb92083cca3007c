#include "io/patterns/quality.h"

#include <gtest/gtest.h>

namespace obscura::tools {
namespace {

// Checks the order only: more samples have a smaller error, and well-known point sets a larger one
// than ours.
TEST(PatternQuality, MoreSamplesAreBetter) {
  EXPECT_LT(quality(disk_pattern(16, false)).both(), quality(disk_pattern(4, false)).both() / 2);
  EXPECT_LT(quality(ball_pattern(32)).both(), quality(ball_pattern(8)).both() / 2);
}

// The paper's claim, for the sizes that matter: ours beat Poisson, stratified, Hammersley and R2.
TEST(PatternQuality, OursWinFrom3To16) {
  for (int n = 3; n <= 16; ++n) {
    const double disk = quality(disk_pattern(n, false)).both();
    const double ball = quality(ball_pattern(n)).both();
    for (int r = 0; r < 4; ++r) {
      const auto rival = static_cast<RivalPattern>(r);
      for (const bool by_density : {false, true}) {
        EXPECT_LT(disk,
                  quality(std::span<const DiskSample>(rival_disk(rival, n, by_density, 1))).both())
            << n << " " << kRivalNames[r];
      }
      if (n % 3 != 0) continue;  // the ball's cells take long
      EXPECT_LT(ball, quality(std::span<const BallSample>(rival_ball(rival, n, 1))).both())
          << n << " " << kRivalNames[r];
    }
  }
}

// The measure itself: wrong weights give a larger error.
TEST(PatternQuality, WrongWeightsAreWorse) {
  std::vector<DiskSample> samples(disk_pattern(9, false).begin(), disk_pattern(9, false).end());
  const double right = quality(std::span<const DiskSample>(samples)).both();
  samples[0].weight_constant *= 4;
  EXPECT_GT(quality(std::span<const DiskSample>(samples)).both(), 1.5 * right);
}

}  // namespace
}  // namespace obscura::tools
