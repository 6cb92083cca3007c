#include "io/environments/convolution_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "io/images/files.h"

namespace obscura::tools {
namespace {

constexpr PreconvolutionSettings kSmall{.cells = 4, .source_cells = 8};

class ConvolutionCacheTest : public testing::Test {
 protected:
  ConvolutionCacheTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "obscura-XXXXXX").string();
    cache_.folder = std::string(mkdtemp(pattern.data())) + "/new/folder";
    EXPECT_TRUE(open_environment("sky:model=overcast,intensity=2", &source_).ok());
  }
  ~ConvolutionCacheTest() override {
    std::filesystem::remove_all(std::filesystem::path(cache_.folder).parent_path().parent_path());
  }
  // Whether it came from the cache.
  bool get(PreconvolvedEnvironment* e) {
    EnvironmentRepairs repairs;
    bool from_cache = false;
    const Status s = preconvolve(source_, kSmall, cache_, e, &repairs, &from_cache);
    EXPECT_TRUE(s.ok()) << s.message();
    return from_cache;
  }
  static bool same(const PreconvolvedEnvironment& a, const PreconvolvedEnvironment& b) {
    return std::equal(a.table().begin(), a.table().end(), b.table().begin(), b.table().end());
  }
  std::string file() const { return cache_.path(source_, kSmall); }

  ConvolutionCache cache_;
  EnvironmentSource source_;
};

TEST_F(ConvolutionCacheTest, KeepsAndFindsAgain) {
  PreconvolvedEnvironment first, second;
  EXPECT_FALSE(get(&first));
  EXPECT_TRUE(get(&second));
  EXPECT_TRUE(same(first, second));
}

TEST_F(ConvolutionCacheTest, OtherContentIsAnotherFile) {
  PreconvolvedEnvironment e;
  const std::string before = file();
  get(&e);
  ASSERT_TRUE(open_environment("sky:model=overcast,intensity=3", &source_).ok());
  EXPECT_NE(file(), before);
  EXPECT_FALSE(get(&e));
}

TEST_F(ConvolutionCacheTest, DamagedFilesAreReplaced) {
  PreconvolvedEnvironment first, again;
  get(&first);
  std::string good;
  ASSERT_TRUE(read_bytes(file(), &good).ok());
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  std::string other_version = good;
  other_version[20] = '9';
  for (const std::string& bad :
       {std::string(), good.substr(0, 100), good.substr(0, good.size() - 1), good + "x", flipped,
        other_version}) {
    ASSERT_TRUE(write_text(file(), bad).ok());
    EXPECT_FALSE(get(&again));
    EXPECT_TRUE(same(first, again));
    EXPECT_TRUE(get(&again));
  }
}

TEST_F(ConvolutionCacheTest, DoesWithoutAFolder) {
  PreconvolvedEnvironment e;
  cache_.folder = "/proc/not/writable";
  EXPECT_FALSE(get(&e));
  EXPECT_FALSE(get(&e));
  cache_.folder = "";
  EXPECT_FALSE(get(&e));
  cache_.enabled = false;
  EXPECT_FALSE(get(&e));
}

TEST_F(ConvolutionCacheTest, FollowsTheXdgSpecification) {
  const char* old_xdg = std::getenv("XDG_CACHE_HOME");
  const std::string kept = old_xdg ? old_xdg : "";
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(ConvolutionCache::default_folder(), "/somewhere/obscura");
  setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_TRUE(ConvolutionCache::default_folder().ends_with("/.cache/obscura"));
  if (old_xdg) setenv("XDG_CACHE_HOME", kept.c_str(), 1);
  if (!old_xdg) unsetenv("XDG_CACHE_HOME");
}

TEST(EnvironmentFile, SkyTextIsRead) {
  EnvironmentSource source;
  ASSERT_TRUE(open_environment("sky", &source).ok());
  EXPECT_EQ(source.sky.model, SkyModel::kClear);
  ASSERT_TRUE(open_environment("sky:elevation-deg=12.5,model=overcast", &source).ok());
  EXPECT_EQ(source.sky.elevation_deg, 12.5f);
  EXPECT_EQ(source.sky.model, SkyModel::kOvercast);
  for (const char* bad : {"sky:elevation-deg", "sky:foo=1", "sky:turbidity=99", "sky:model=blue",
                          "x.jpg", "", "missing.hdr"}) {
    EXPECT_FALSE(open_environment(bad, &source).ok()) << bad;
  }
}

}  // namespace
}  // namespace obscura::tools
