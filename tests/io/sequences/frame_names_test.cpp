#include "io/sequences/frame_names.h"

#include <gtest/gtest.h>

namespace obscura::tools {
namespace {

TEST(FrameNames, PlacesAreThoseOfCompositorsPrintfAndHoudini) {
  const struct {
    const char *name, *of_seven;
  } cases[] = {{"shot.####.exr", "shot.0007.exr"},     {"shot.#.exr", "shot.7.exr"},
               {"shot.%04d.exr", "shot.0007.exr"},     {"shot.%d.exr", "shot.7.exr"},
               {"shot.$F4.exr", "shot.0007.exr"},      {"shot.$F.exr", "shot.7.exr"},
               {"##/shot.%03d.exr", "07/shot.007.exr"}};
  for (const auto& c : cases) {
    EXPECT_TRUE(has_frame_number(c.name)) << c.name;
    EXPECT_EQ(name_of_frame(c.name, 7), c.of_seven);
  }
  for (const char* name : {"shot.exr", "100%.exr", "a%s.exr", "a%4d.exr", "cost$5.exr", "%", "$"}) {
    EXPECT_FALSE(has_frame_number(name)) << name;
    EXPECT_EQ(name_of_frame(name, 7), name);
  }
  EXPECT_EQ(name_of_frame("a.##.exr", 1234), "a.1234.exr");
  EXPECT_EQ(name_of_frame("a.####.exr", -5), "a.-0005.exr");  // four digits and the sign
  EXPECT_EQ(name_of_frame("a.%04d.exr", -5), "a.-005.exr");   // as printf
}

TEST(FrameNames, ListsHaveRangesStepsAndEachFrameOnce) {
  const struct {
    const char* text;
    std::vector<int> frames;
  } cases[] = {{"5", {5}},
               {"1-4", {1, 2, 3, 4}},
               {"1-8x3", {1, 4, 7}},
               {"9,1-3,2-4", {9, 1, 2, 3, 4}},
               {"-2-1", {-2, -1, 0, 1}},
               {"-4--3", {-4, -3}}};
  for (const auto& c : cases) {
    std::vector<int> frames;
    ASSERT_TRUE(parse_frames(c.text, &frames).ok()) << c.text;
    EXPECT_EQ(frames, c.frames) << c.text;
  }
  for (const char* text : {"", "a", "1-", "-", "1-4x", "1-4x0", "4-1", "1,,2", "1-4x-1", "1 2",
                           "1-99999999", "1-2000000", "1x2", "99999999999999999999"}) {
    std::vector<int> frames = {3};
    EXPECT_FALSE(parse_frames(text, &frames).ok()) << text;
    EXPECT_EQ(frames, std::vector<int>{3}) << text;
  }
}

TEST(FrameNames, ShardsCountFromOne) {
  Shard shard;
  ASSERT_TRUE(parse_shard("2/5", &shard).ok());
  EXPECT_EQ(shard.index, 2);
  EXPECT_EQ(shard.count, 5);
  for (const char* text : {"", "0/5", "6/5", "1", "1/", "/5", "1/0", "a/b", "1/5x"}) {
    EXPECT_FALSE(parse_shard(text, &shard).ok()) << text;
  }
}

}  // namespace
}  // namespace obscura::tools
