#include "io/patterns/pattern_files.h"

#include <gtest/gtest.h>

namespace obscura::tools {
namespace {

// Six of the 128; `obscura patterns --check 128` makes them all again.
TEST(PatternFiles, PatternsAreMadeAsTheyShip) {
  for (const PatternTable table : {PatternTable::kDisks, PatternTable::kCenteredDisks}) {
    EXPECT_TRUE(pattern_ships_as_made(table, 3)) << enum_name(table);
    EXPECT_TRUE(pattern_ships_as_made(table, 5)) << enum_name(table);
  }
  EXPECT_TRUE(pattern_ships_as_made(PatternTable::kBalls, 2));
  EXPECT_TRUE(pattern_ships_as_made(PatternTable::kBalls, 4));
}

}  // namespace
}  // namespace obscura::tools
