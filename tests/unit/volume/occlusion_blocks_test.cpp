// The occlusion sweep block by block.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "obscura/volume_blocks.h"
#include "tests/reference/volume_sweeps.h"

namespace obscura {
namespace {

using reference::Grid;
using Cuts = std::vector<int>;  // first planes of the blocks, and the end

Grid blobs(std::array<int, 3> n) {
  Grid d(n, {1, 1.5f, 1});
  d.fill([](double x, double y, double z) {
    return std::min(std::hypot(x - 9.3, y - 8.1, z - 13.7) - 4.4, z - 2.3 + 0.1 * x);
  });
  return d;
}

// All octants of every block, one after another, with faces that go from block to block.
std::vector<std::vector<float>> by_blocks(const Grid& d, const Cuts& cuts,
                                          const OcclusionSettings& settings,
                                          const RunOptions& run) {
  const int count = static_cast<int>(cuts.size()) - 1;
  std::vector<OcclusionBlock> blocks(static_cast<std::size_t>(count));
  for (int b = 0; b < count; ++b) {
    const Grid& whole = d;
    const GridView<const float> slab(whole.v.data() + whole.at(0, 0, cuts[b]),
                                     {d.size[0], d.size[1], cuts[b + 1] - cuts[b]}, d.spacing);
    const Status s = blocks[b].start(slab, settings, run);
    EXPECT_TRUE(s.ok()) << s.message();
  }
  std::vector<std::int16_t> face(blocks[0].face_size());
  for (const bool rising : {true, false}) {
    for (int i = 0; i < count; ++i) {
      std::span<const std::int16_t> upwind;
      if (i > 0) upwind = face;
      const Status s = blocks[rising ? i : count - 1 - i].sweep(rising, upwind, face, run);
      EXPECT_TRUE(s.ok()) << s.message();
    }
  }
  std::vector<std::vector<float>> all(9);
  for (const OcclusionBlock& block : blocks) {
    Grid part(block.field().size());
    const GridView<float> out(part.v.data(), part.size, part.spacing);
    for (int s = 0; s < 9; ++s) {
      EXPECT_TRUE((s < 8 ? block.field().octant(s, out) : block.field().scalar(out)).ok());
      all[s].insert(all[s].end(), part.v.begin(), part.v.end());
    }
  }
  return all;
}

TEST(OcclusionBlocks, GiveTheBitsOfTheWholeForAnySplit) {
  for (const std::array<int, 3>& n : {std::array{45, 31, 27}, {20, 150, 27}, {5, 1, 27}}) {
    const Grid d = blobs(n);
    for (const Transport t :
         {Transport::kPaper, Transport::kFast, Transport::kBalanced, Transport::kAccurate}) {
      for (const float alpha : {1.0f, 0.3f}) {
        const OcclusionSettings settings{.transport = t, .alpha = alpha};
        VisibilityField whole;
        ASSERT_TRUE(sweep_occlusion({d.v.data(), d.size, d.spacing}, settings, &whole).ok());
        Grid one(whole.size());
        const GridView<float> out(one.v.data(), one.size, one.spacing);
        for (const Cuts& cuts : {Cuts{0, 27}, {0, 12, 27}, {0, 2, 4, 26, 27}, {0, 6, 14, 18, 27}}) {
          const auto blocks = by_blocks(d, cuts, settings, {.threads = cuts.size() > 4 ? 3 : 1});
          for (int s = 0; s < 9; ++s) {
            ASSERT_TRUE((s < 8 ? whole.octant(s, out) : whole.scalar(out)).ok());
            ASSERT_EQ(one.v, blocks[s]) << enum_name(t) << ", alpha " << alpha << ", "
                                        << cuts.size() - 1 << " blocks, field " << s;
          }
        }
      }
    }
  }
}

// A face that is not passed on is seen: below the floor's border the block would be open.
TEST(OcclusionBlocks, NeedTheirFaces) {
  const Grid d = blobs({20, 30, 24});
  OcclusionBlock low, high;
  ASSERT_TRUE(low.start({d.v.data(), {20, 30, 12}, d.spacing}, {}).ok());
  ASSERT_TRUE(high.start({d.v.data() + d.at(0, 0, 12), {20, 30, 12}, d.spacing}, {}).ok());
  std::vector<std::int16_t> face(low.face_size());
  ASSERT_TRUE(low.sweep(true, {}, face).ok());
  ASSERT_TRUE(high.sweep(true, face, {}).ok());
  Grid with(high.field().size()), without(high.field().size());
  ASSERT_TRUE(high.field().octant(0, {with.v.data(), with.size, with.spacing}).ok());
  ASSERT_TRUE(high.sweep(true, {}, {}).ok());
  ASSERT_TRUE(high.field().octant(0, {without.v.data(), without.size, without.spacing}).ok());
  EXPECT_NE(with.v, without.v);
}

TEST(OcclusionBlocks, KeepAndBringBackAHalf) {
  const Grid d = blobs({20, 30, 24});
  OcclusionBlock block, other;
  EXPECT_TRUE(block.half(true).empty());
  ASSERT_TRUE(block.start({d.v.data(), d.size, d.spacing}, {}).ok());
  ASSERT_TRUE(block.sweep(true, {}, {}).ok());
  ASSERT_TRUE(other.start({d.v.data(), d.size, d.spacing}, {}).ok());
  auto copy = [&](std::span<std::uint8_t> to) -> Status {
    EXPECT_EQ(to.size(), block.half(true).size());
    std::copy(block.half(true).begin(), block.half(true).end(), to.begin());
    return {};
  };
  EXPECT_TRUE(other.half(true).empty());
  ASSERT_TRUE(other.restore(true, copy).ok());
  Grid a(block.field().size()), b(block.field().size());
  ASSERT_TRUE(block.field().octant(2, {a.v.data(), a.size, a.spacing}).ok());
  ASSERT_TRUE(other.field().octant(2, {b.v.data(), b.size, b.spacing}).ok());
  EXPECT_EQ(a.v, b.v);
}

// Every block of the turned grid is shaded by every block of distances, each by itself, and the
// least of the values is taken, as ranks do that hold a slab each.
TEST(OcclusionBlocks, ShadowsHaveTheBitsOfTheWhole) {
  const Grid d = blobs({25, 31, 27});
  const Cuts slabs{0, 9, 10, 26, 27};
  for (const std::array<float, 3>& light :
       {std::array{1.0f, 2.0f, 3.0f}, {-1, -1, -1}, {0, 0, 1}, {1, -0.2f, 0}}) {
    for (const Transport t : {Transport::kPaper, Transport::kBalanced}) {
      const OcclusionSettings settings{.transport = t, .alpha = 0.8f};
      VisibilityField whole;
      ASSERT_TRUE(sweep_shadow({d.v.data(), d.size, d.spacing}, light, settings, &whole).ok());
      Grid one(whole.size());
      ASSERT_TRUE(whole.octant(7, {one.v.data(), one.size, one.spacing}).ok());
      int planes = 0;
      ASSERT_TRUE(shadow_planes(d.size, d.spacing, light, settings, &planes).ok());
      ASSERT_EQ(planes, whole.size()[2]);
      std::vector<float> all(one.v.size());
      std::vector<std::int16_t> face;
      const Cuts cuts{0, 3, planes / 2, planes};
      for (std::size_t b = cuts.size() - 1; b-- > 0;) {  // the light falls
        OcclusionBlock block;
        ASSERT_TRUE(
            block.start_shadow(d.size, d.spacing, light, settings, cuts[b], cuts[b + 1]).ok());
        for (std::size_t i = 0; i + 1 < slabs.size(); ++i) {
          OcclusionBlock own;
          ASSERT_TRUE(
              own.start_shadow(d.size, d.spacing, light, settings, cuts[b], cuts[b + 1]).ok());
          const int end = std::min(slabs[i + 1] + 1, d.size[2]);
          const GridView<const float> slab(d.v.data() + d.at(0, 0, slabs[i]),
                                           {d.size[0], d.size[1], end - slabs[i]}, d.spacing);
          ASSERT_TRUE(own.shade(slab, slabs[i]).ok());
          std::ranges::transform(block.transmittance(), own.transmittance(),
                                 block.transmittance().begin(),
                                 [](std::uint8_t a, std::uint8_t v) { return std::min(a, v); });
        }
        const std::vector<std::int16_t> up = face;
        face.resize(block.face_size());
        ASSERT_TRUE(block.sweep(false, up, face).ok());
        const auto size = block.field().size();
        const GridView<float> out(all.data() + one.at(0, 0, cuts[b]), size, one.spacing);
        ASSERT_TRUE(block.field().octant(7, out).ok());
      }
      EXPECT_EQ(one.v, all) << enum_name(t) << ", light " << light[0] << "," << light[1];
    }
  }
}

TEST(OcclusionBlocks, ShadowsNameMistakes) {
  const Grid d = blobs({25, 31, 27});
  OcclusionBlock block;
  EXPECT_EQ(block.shade({d.v.data(), d.size, d.spacing}, 0).message(),
            "the block is none of a shadow; call start_shadow first");
  Status s = block.start_shadow(d.size, d.spacing, {0, 0, 1}, {}, 0, 1000);
  EXPECT_NE(s.message().find("the block has planes 0 to 1000; they must be some of"),
            std::string::npos)
      << s.message();
  s = block.start_shadow(d.size, d.spacing, {0, 0, 0}, {}, 0, 1);
  EXPECT_EQ(s.message(), "to_light is (0, 0, 0); it must be finite and not zero");
  ASSERT_TRUE(block.start_shadow(d.size, d.spacing, {0, 0, 1}, {}, 0, 4).ok());
  EXPECT_EQ(block.shade({d.v.data(), d.size, d.spacing}, 1).message(),
            "distance holds 25x31x27 voxels from plane 1 on; they must be planes of the volume's "
            "25x31x27");
}

// The next block of a size takes the memory of the one before, and none of its values.
TEST(OcclusionBlocks, AreStartedAgain) {
  const Grid d = blobs({20, 30, 48});
  OcclusionBlock again, fresh;
  ASSERT_TRUE(again.start({d.v.data(), {20, 30, 24}, d.spacing}, {}).ok());
  ASSERT_TRUE(again.sweep(true, {}, {}).ok());
  const void* memory = again.half(true).data();
  const GridView<const float> upper(d.v.data() + d.at(0, 0, 24), {20, 30, 24}, d.spacing);
  for (OcclusionBlock* block : {&again, &fresh}) {
    ASSERT_TRUE(block->start(upper, {}).ok());
    EXPECT_TRUE(block->half(true).empty());
    ASSERT_TRUE(block->sweep(true, {}, {}).ok());
  }
  EXPECT_EQ(again.half(true).data(), memory);
  EXPECT_TRUE(std::ranges::equal(again.half(true), fresh.half(true)));
}

TEST(OcclusionBlocks, RefuseWhatTheyCannotSweep) {
  const Grid d = blobs({20, 30, 24});
  OcclusionBlock block;
  EXPECT_EQ(block.sweep(true, {}, {}).message(),
            "the block has no transmittances; call start with its distances first");
  EXPECT_TRUE(block.field().empty());
  EXPECT_EQ(block.start({d.v.data(), d.size, d.spacing}, {.precision = VisibilityPrecision::kF32})
                .message(),
            "precision is f32; blocks are swept as u8");
  ASSERT_TRUE(block.start({d.v.data(), d.size, d.spacing}, {}).ok());
  std::vector<std::int16_t> face(block.face_size(), -1);
  EXPECT_EQ(block.sweep(true, face, {}).message(), "upwind holds -1; it must be in [0, 32767]");
  face.pop_back();
  EXPECT_EQ(block.sweep(true, {}, face).message(),
            "downwind holds 3599 numbers; it must be empty or hold 3600, as face_size() says");
}

}  // namespace
}  // namespace obscura
