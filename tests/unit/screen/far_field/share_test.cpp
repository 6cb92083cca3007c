#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "math/leaf_scalar.h"
#include "screen/far_field/share_kernel.h"

namespace obscura {
namespace leaf_scalar {
#include "screen/far_field/share_leaf.h"
}  // namespace leaf_scalar

namespace {

// Each cell of a group has another share; dense tiles have every n-th, each equally often.
TEST(Share, EveryDirectionIsEvaluatedInAGroup) {
  for (int side : {2, 3}) {
    std::set<int> shares;
    std::vector<int> often(side * side);
    for (int cell = 0; cell < side * side; ++cell) {
      const int own = leaf_scalar::share_of_cell(cell / side, cell % side, side);
      shares.insert(own);
      for (int share = 0; share < side * side; ++share) {
        EXPECT_EQ(leaf_scalar::has_share(own, share, side, false), share == own);
        often[share] += leaf_scalar::has_share(own, share, side, true);
      }
    }
    EXPECT_EQ(shares.size(), side * side);
    EXPECT_EQ(often, std::vector<int>(side * side, side));
  }
}

// Rows and columns of 3 x 3 cells have the same mean.
TEST(Share, ThreeTimesThreeIsAMagicSquare) {
  for (int i = 0; i < 3; ++i) {
    int row = 0, column = 0;
    for (int k = 0; k < 3; ++k) {
      row += leaf_scalar::share_of_cell(i, k, 3);
      column += leaf_scalar::share_of_cell(k, i, 3);
    }
    EXPECT_EQ(row, 12);
    EXPECT_EQ(column, 12);
  }
}

far_field::ShareJob wall(int side, int count) {
  far_field::ShareJob job;
  job.side = side;
  job.channels = 1;
  job.count = count;
  job.view = {.scale_x = 0.01f, .scale_y = 0.01f, .parallel = false};
  for (auto& row : job.rows) {
    for (int i = 0; i < count + 2; ++i) {
      row.depth[i] = 2;
      row.normal[2][i] = 1;
      row.shares[i] = 1;
    }
  }
  return job;
}

// On a wall every pixel gets each share once.
TEST(Share, AWallTakesEachShareOnce) {
  for (int side : {2, 3}) {
    const int count = 21;
    far_field::ShareJob job = wall(side, count);
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < count + 2; ++x) {
        job.rows[y].sums[0][x] = 1 << leaf_scalar::share_of_cell(y % side, x % side, side);
      }
    }
    std::vector<float> out(count);
    job.out[0] = out.data();
    far_field::share_row(&job);
    const float all = static_cast<float>((1 << side * side) - 1);
    for (float v : out) EXPECT_NEAR(v, all, 1e-5f * all);
    far_field::find_known(&job);
    for (int i = 0; i < count; ++i) {
      EXPECT_EQ(job.known[i], leaf_scalar::kKnownUnits * side * side);
    }
  }
}

// A pixel before or behind all others has its own share only, the background none.
TEST(Share, APixelAloneIsLeftAlone) {
  for (int side : {2, 3}) {
    far_field::ShareJob job = wall(side, 3);
    for (auto& row : job.rows) std::fill_n(row.sums[0], 5, 7.0f);
    job.rows[1].depth[1] = 1.9f;
    job.rows[1].depth[3] = std::numeric_limits<float>::infinity();
    job.rows[1].sums[0][1] = 0.5f;
    std::vector<float> out(3);
    job.out[0] = out.data();
    far_field::share_row(&job);
    EXPECT_FLOAT_EQ(out[0], 0.5f * static_cast<float>(side * side));
    EXPECT_NEAR(out[1], 7 * side * side, 1e-4);
    EXPECT_EQ(out[2], 0);
    far_field::find_known(&job);
    EXPECT_EQ(job.known[0], leaf_scalar::kKnownUnits);
    EXPECT_EQ(job.known[2], leaf_scalar::kKnownUnits * side * side);
  }
}

}  // namespace
}  // namespace obscura
