#include "obscura/version.h"

#include <gtest/gtest.h>

#include <string>

namespace obscura {
namespace {

TEST(Version, HeadersAndLibraryAgree) {
  EXPECT_EQ(version(), std::to_string(OBSCURA_VERSION_MAJOR) + "." +
                           std::to_string(OBSCURA_VERSION_MINOR) + "." +
                           std::to_string(OBSCURA_VERSION_PATCH));
}

TEST(Version, NumbersCompareAsVersionsDo) {
  EXPECT_LT(OBSCURA_MAKE_VERSION(0, 1, 999), OBSCURA_MAKE_VERSION(0, 2, 0));
  EXPECT_LT(OBSCURA_MAKE_VERSION(0, 999, 999), OBSCURA_MAKE_VERSION(1, 0, 0));
  EXPECT_GE(OBSCURA_VERSION, OBSCURA_MAKE_VERSION(0, 1, 0));
}

}  // namespace
}  // namespace obscura
