#include "obscura/simd.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "obscura/version.h"

namespace obscura {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

TEST(Simd, LimitsHoldAndAreLifted) {
  const std::string before = simd_limit();
  const std::vector<std::string> targets = simd_targets();
  ASSERT_FALSE(targets.empty());
  for (const std::string& target : targets) {
    ASSERT_TRUE(limit_simd(target).ok());
    EXPECT_EQ(lower(simd_target()), target);
    EXPECT_EQ(simd_limit(), target);
    EXPECT_EQ(simd_targets(), targets);
  }
  ASSERT_TRUE(limit_simd("").ok());
  EXPECT_EQ(lower(simd_target()), targets.back());
  EXPECT_TRUE(limit_simd(before).ok());
}

TEST(Simd, UnknownTargetsAreRefusedByName) {
  const std::string before = simd_limit();
  const Status s = limit_simd("abacus");
  EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
  EXPECT_NE(s.message().find("'abacus'"), std::string::npos);
  EXPECT_NE(s.message().find(simd_targets().front()), std::string::npos);
  EXPECT_EQ(simd_limit(), before);
}

}  // namespace
}  // namespace obscura
