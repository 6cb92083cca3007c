// The distance sweep block by block.
#include <gtest/gtest.h>

#include <cmath>

#include "obscura/volume_blocks.h"
#include "tests/reference/volume_sweeps.h"

namespace obscura {
namespace {

using reference::Grid;
using Cuts = std::vector<int>;  // first planes of the blocks, and the end

Grid blobs(std::array<int, 3> n, std::array<float, 3> h) {
  Grid f(n, h);
  f.fill([](double x, double y, double z) {
    const double low = std::hypot(x - 9.3, y - 18.1, z - 6.7) - 4.4;
    const double high = std::hypot(x - 15.2, y - 60.4, z - 17.9) - 5.7;
    return std::min(low, high);
  });
  return f;
}

VolumeView view_of(const Grid& f, int begin, int end) {
  VolumeView view;
  view.data = f.v.data() + f.at(0, 0, begin);
  view.size = {f.size[0], f.size[1], end - begin};
  view.spacing = f.spacing;
  return view;
}

DistanceSettings settings_of(int sweeps) {
  DistanceSettings settings;
  settings.solid = SolidSide::kBelow;
  settings.sweeps = sweeps;
  return settings;
}

// Every block in memory of its own, as if each were on another machine.
std::vector<float> by_blocks(const Grid& f, const Cuts& cuts, int rounds, const RunOptions& run,
                             bool* changed) {
  const int nx = f.size[0], ny = f.size[1], depth = f.size[2];
  const int blocks = static_cast<int>(cuts.size()) - 1;
  std::vector<Grid> distance;
  auto out = [&](int b) {
    return GridView<float>(distance[b].v.data(), distance[b].size, f.spacing);
  };
  for (int b = 0; b < blocks; ++b) {
    distance.emplace_back(std::array{nx, ny, cuts[b + 1] - cuts[b]}, f.spacing, -7.0f);
    const bool below = cuts[b] > 0, above = cuts[b + 1] < depth;
    const Status s = start_distance_block(view_of(f, cuts[b] - below, cuts[b + 1] + above), below,
                                          above, settings_of(8), out(b), run);
    EXPECT_TRUE(s.ok()) << s.message();
  }
  std::vector<float> face(distance_face_size(nx, ny));
  for (int round = 0; round < rounds; ++round) {
    *changed = false;
    for (const bool rising : {true, false}) {
      for (int i = 0; i < blocks; ++i) {
        std::span<const float> upwind;
        if (i > 0) upwind = face;
        bool fell = false;
        const Status s = sweep_distance_block(out(rising ? i : blocks - 1 - i), rising, upwind,
                                              face, &fell, run);
        EXPECT_TRUE(s.ok()) << s.message();
        *changed = *changed || fell;
      }
    }
  }
  std::vector<float> all;
  for (const Grid& d : distance) all.insert(all.end(), d.v.begin(), d.v.end());
  return all;
}

TEST(DistanceBlocks, GiveTheBitsOfTheWholeForAnySplit) {
  for (const std::array<int, 3>& n : {std::array{40, 70, 29}, {61, 43, 29}, {25, 19, 29}}) {
    const Grid f = blobs(n, {1, n[0] == 61 ? 1.2f : 1.0f, 1});
    for (const int rounds : {1, 2}) {
      std::vector<float> whole(f.v.size());
      ASSERT_TRUE(sweep_distance(view_of(f, 0, n[2]), settings_of(8 * rounds),
                                 {whole.data(), f.size, f.spacing})
                      .ok());
      for (const Cuts& cuts :
           {Cuts{0, 29}, {0, 13, 29}, {0, 1, 2, 28, 29}, {0, 5, 9, 11, 20, 29}}) {
        for (const int threads : {1, 3}) {
          bool changed = false;
          EXPECT_EQ(whole, by_blocks(f, cuts, rounds, {.threads = threads}, &changed))
              << cuts.size() - 1 << " blocks, " << rounds << " rounds, " << threads << " threads";
        }
      }
    }
  }
}

// A sphere's distances have converged after a few rounds, and then no block falls any more.
TEST(DistanceBlocks, SayWhetherAnyDistanceFell) {
  const Grid f = blobs({25, 70, 29}, {1, 1, 1});
  bool changed = false;
  by_blocks(f, {0, 9, 29}, 1, {}, &changed);
  EXPECT_TRUE(changed);
  by_blocks(f, {0, 9, 29}, 12, {}, &changed);
  EXPECT_FALSE(changed);
}

TEST(DistanceBlocks, RefuseFacesAndSamplesOfOtherSizes) {
  const Grid f = blobs({25, 19, 12}, {1, 1, 1});
  Grid d({25, 19, 6});
  const GridView<float> out(d.v.data(), d.size, d.spacing);
  std::vector<float> face(100);
  Status s = sweep_distance_block(out, true, face, {});
  EXPECT_EQ(s.message(), "upwind holds 100 floats; it must be empty or hold 950, two planes");
  s = sweep_distance_block(out, true, {}, face);
  EXPECT_EQ(s.message(), "downwind holds 100 floats; it must be empty or hold 950, two planes");
  s = start_distance_block(view_of(f, 0, 12), true, true, settings_of(8), out);
  EXPECT_EQ(s.message(),
            "samples.size is 25x19x12; it must be distance's, 25x19x6, with 2 more along z");
  EXPECT_TRUE(check_isovalue({.min = -1, .max = 2}, settings_of(8)).ok());
  EXPECT_EQ(check_isovalue({.min = 1, .max = 2}, settings_of(8)).message(),
            "isovalue is 0, which does not cut the volume; its values go from 1 to 2");
}

}  // namespace
}  // namespace obscura
