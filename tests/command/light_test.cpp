#include <cmath>

#include "io/images/files.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

constexpr const char* kHall = "light scene:hall --size 32x18 --method geometric --rays 16 ";

class LightCommandTest : public CommandTest {};

TEST_F(LightCommandTest, WritesRadiance) {
  for (const char* more : {"", "--cones mean", "--technique bent-normal --geometric-term",
                           "--technique ambient-occlusion --albedo 0.5,0.5,0.5",
                           "--sun-direction 1,1,1 --heading-deg 90"}) {
    const CommandResult r =
        run(std::string(kHall) + "--environment sky:turbidity=4 -o lit.exr " + more);
    ASSERT_EQ(r.code, 0) << more << r.err;
    tools::Image image;
    ASSERT_TRUE(tools::read_image(path("lit.exr"), &image).ok());
    ASSERT_EQ(image.channels.size(), 3u);
    double sum = 0;
    for (const auto& channel : image.channels) {
      for (float v : channel.values) {
        ASSERT_TRUE(std::isfinite(v) && v >= 0);
        sum += v;
      }
    }
    EXPECT_GT(sum, 1);
  }
}

// With uniform light and no falloff the lit picture equals visibility, for every technique.
TEST_F(LightCommandTest, UniformSkyGivesVisibility) {
  ASSERT_EQ(run("ao scene:hall --size 32x18 --rays 16 --method geometric -o v.pfm").code, 0);
  tools::Image visibility, lit;
  ASSERT_TRUE(tools::read_image(path("v.pfm"), &visibility).ok());
  for (const char* technique : {"ambient-occlusion", "bent-normal", "bent-cone"}) {
    const CommandResult r = run(
        std::string(kHall) + "--environment sky:model=uniform -o lit.pfm --technique " + technique);
    ASSERT_EQ(r.code, 0) << r.err;
    ASSERT_TRUE(tools::read_image(path("lit.pfm"), &lit).ok());
    for (std::size_t i = 0; i < lit.channels[0].values.size(); ++i) {
      const float v = visibility.channels[0].values[i];
      EXPECT_NEAR(lit.channels[0].values[i], v, 0.005 * v + 1e-6);
    }
  }
}

// Open surfaces under uniform light have its radiance, for every kind of sampling.
TEST_F(LightCommandTest, ComparatorsLightThePicture) {
  for (const char* how : {"samples --method hemisphere --samples 16", "samples --method ray-traced",
                          "importance --method hemisphere --samples 64"}) {
    const CommandResult r =
        run(std::string("light scene:plane --size 32x18 --radius 1 --environment "
                        "sky:model=uniform -o lit.pfm --comparator ") +
            how);
    ASSERT_EQ(r.code, 0) << r.err;
    tools::Image lit;
    ASSERT_TRUE(tools::read_image(path("lit.pfm"), &lit).ok());
    double sum = 0;
    for (float v : lit.channels[0].values) sum += v;
    EXPECT_NEAR(sum / lit.channels[0].values.size(), 1, 0.02) << how;
  }
  const CommandResult r = run(std::string(kHall) + "--environment sky -o x.exr --comparator best");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("--comparator is 'best'; it must be one of"), std::string::npos) << r.err;
  const CommandResult other =
      run(std::string(kHall) + "--environment sky -o x.exr --comparator samples");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("needs --method hemisphere or ray-traced"), std::string::npos);
}

TEST_F(LightCommandTest, SupersamplingAveragesPixels) {
  const std::string command = "light scene:hall --size 32x18 --environment sky -o ";
  ASSERT_EQ(run(command + "full.pfm").code, 0);
  ASSERT_EQ(run(command + "half.pfm --supersample 2").code, 0);
  tools::Image full, half;
  ASSERT_TRUE(tools::read_image(path("full.pfm"), &full).ok());
  ASSERT_TRUE(tools::read_image(path("half.pfm"), &half).ok());
  ASSERT_EQ(half.width, 16);
  ASSERT_EQ(half.height, 9);
  const std::vector<float>&f = full.channels[1].values, &h = half.channels[1].values;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 16; ++x) {
      const float* a = &f[std::size_t(2 * y) * 32 + 2 * x];
      EXPECT_NEAR(h[y * 16 + x], (a[0] + a[1] + a[32] + a[33]) / 4, 1e-5f);
    }
  }
  const CommandResult r = run(command + "x.pfm --supersample 4");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("--supersample is 4"), std::string::npos) << r.err;
}

TEST_F(LightCommandTest, KeepsTheConvolution) {
  const std::string command = "light scene:hall --size 16x9 --environment sky -o lit.png";
  EXPECT_EQ(run(command).code, 0);
  const CommandResult again = run(command);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("(cached)"), std::string::npos) << again.out;
  const CommandResult anew = run(command + " --no-cache");
  EXPECT_EQ(anew.code, 0) << anew.err;
  EXPECT_EQ(anew.out.find("(cached)"), std::string::npos) << anew.out;
}

TEST_F(LightCommandTest, BadUsageAndBadInputAreTold) {
  const std::string hall = kHall;
  expect_failure(hall + "-o a.png", 2, "--environment");
  expect_failure(hall + "--environment sky:blue=1 -o a.png", 2, "sky has no setting 'blue=1'");
  expect_failure(hall + "--environment sky --albedo 1,2 -o a.png", 2, "three numbers");
  expect_failure(hall + "--environment sky --sun-direction 0,0,0 -o a.png", 2, "sun direction");
  expect_failure(hall + "--environment sky -o a.jpg", 2, "a.jpg");
  expect_failure(hall + "--environment sky --technique cone -o a.png", 2, "--technique");
  expect_failure("light scene:hall --size 32x18 --environment sky --method line -o a.png", 2,
                 "bent-normal");
  // PFM of 2x2: not twice as wide as high.
  write("square.pfm", "Pf\n2 2\n-1\n" + std::string(16, '\0'));
  expect_failure(hall + "--environment square.pfm -o a.png", 3, "twice as wide as high");
  EXPECT_EQ(run(hall + "--environment missing.hdr -o a.png").code, 3);
}

}  // namespace
}  // namespace obscura
