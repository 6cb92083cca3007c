#include <algorithm>
#include <cmath>

#include "io/images/files.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

using tools::Image;

// What a person sees of a picture at first glance.
struct Glance {
  double fill = 0;        // the object's longer side, of the picture's shorter side
  double difference = 0;  // of mean luminance, object less background
  double deviation = 0;   // standard deviation of luminance over the object
};

class VolumePicture : public CommandTest {
 protected:
  // Of the command's default picture; the object is where `coverage` is whole.
  Glance glance_at(const std::string& volume, const std::string& size) {
    const std::string command = "volume " + volume + " -q --size " + size;
    expect_success(command + " -o picture.png");
    expect_success(command + " -o coverage.pfm --outputs coverage");
    Image picture, coverage;
    EXPECT_TRUE(tools::read_image(path("picture.png"), &picture).ok());
    EXPECT_TRUE(tools::read_image(path("coverage.pfm"), &coverage).ok());
    Glance g;
    if (picture.channels.size() != 3 || picture.width != coverage.width) {
      ADD_FAILURE() << volume;
      return g;
    }
    auto luminance = [&](std::size_t i) {
      return 0.2126 * picture.channels[0].values[i] + 0.7152 * picture.channels[1].values[i] +
             0.0722 * picture.channels[2].values[i];
    };
    int low[2] = {picture.width, picture.height}, high[2] = {-1, -1};
    double sum = 0, squares = 0, count = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const std::size_t i = std::size_t(y) * picture.width + x;
        const float c = coverage.channels[0].values[i];
        if (c == 0) {
          EXPECT_EQ(luminance(i), luminance(0)) << volume;
        } else {
          low[0] = std::min(low[0], x), high[0] = std::max(high[0], x);
          low[1] = std::min(low[1], y), high[1] = std::max(high[1], y);
        }
        if (c < 1) continue;
        sum += luminance(i);
        squares += luminance(i) * luminance(i);
        ++count;
      }
    }
    g.fill = double(std::max(high[0] - low[0], high[1] - low[1]) + 1) /
             std::min(picture.width, picture.height);
    g.difference = sum / count - luminance(0);
    g.deviation = std::sqrt(squares / count - (sum / count) * (sum / count));
    return g;
  }
  void expect_clear(const std::string& volume, const std::string& size) {
    const Glance g = glance_at(volume, size);
    EXPECT_GE(g.fill, 0.6) << volume;
    EXPECT_LE(g.fill, 0.9) << volume;
    EXPECT_GT(std::abs(g.difference), 0.2) << volume;
    EXPECT_GT(g.deviation, 0.1) << volume;
  }
};

TEST_F(VolumePicture, ShowsShapeAtFirstGlance) {
  for (const char* name : {"gyroid", "sphere", "sphere-over-plane", "pillars", "cup", "open-box",
                           "vessels", "cloud"}) {
    expect_clear(std::string("volume:") + name + "?size=64", "128x128");
  }
}

TEST_F(VolumePicture, ShowsScansAtFirstGlance) {
  const std::string folder = OBSCURA_SOURCE_DIR "/../shared/data/volumes/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared volumes beside the sources";
  for (const char* name : {"MR", "engine", "bonsai"}) {
    expect_clear(folder + name + ".nii.gz", "192x192");
  }
}

// The background is the given colour to the bit depth of the file, and no surface is brighter than
// its own.
TEST_F(VolumePicture, HasTheColoursAskedFor) {
  expect_success(
      "volume volume:sphere?size=24 -q --size 32x32 -o a.png --surface-colour 0,1,0.5 "
      "--background-colour 1,0,0.2");
  Image a;
  ASSERT_TRUE(tools::read_image(path("a.png"), &a).ok());
  const float background[3] = {1, 0, 0.2f}, surface[3] = {0, 1, 0.5f};
  const std::size_t middle = 16 * 32 + 16;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a.channels[k].values[0], background[k], 0.5 / 255 + 1e-6);
    EXPECT_LE(a.channels[k].values[middle], surface[k] + 0.5 / 255);
    EXPECT_GE(a.channels[k].values[middle], 0.7 * surface[k]);
  }
}

TEST_F(VolumePicture, BareVisibilityStays) {
  const std::string volume = "volume volume:cup?size=24 -q --size 32x32 ";
  expect_success(volume + "-o bare.png --light ao");
  expect_success(volume + "-o linear.pfm");
  expect_success(volume + "-o named.png --outputs visibility");
  Image bare, linear, named;
  ASSERT_TRUE(tools::read_image(path("bare.png"), &bare).ok());
  ASSERT_TRUE(tools::read_image(path("linear.pfm"), &linear).ok());
  ASSERT_TRUE(tools::read_image(path("named.png"), &named).ok());
  ASSERT_EQ(bare.channels.size(), 1u);
  EXPECT_EQ(bare.channels[0].values, named.channels[0].values);
  for (std::size_t i = 0; i < bare.channels[0].values.size(); ++i) {
    EXPECT_NEAR(bare.channels[0].values[i], linear.channels[0].values[i], 0.5 / 255 + 1e-6);
  }
}

// Rays in place of the sweep give the same picture but for their noise and the sweep's error.
TEST_F(VolumePicture, RaysAgree) {
  const std::string volume = "volume volume:cup?size=40 --size 48x48 -q ";
  expect_success(volume + "-o sweep.png");
  expect_success(volume + "-o rays.png --method monte-carlo --rays 64");
  Image sweep, rays;
  ASSERT_TRUE(tools::read_image(path("sweep.png"), &sweep).ok());
  ASSERT_TRUE(tools::read_image(path("rays.png"), &rays).ok());
  double error = 0;
  const auto &a = sweep.channels[1].values, &b = rays.channels[1].values;
  for (std::size_t i = 0; i < a.size(); ++i) error += std::abs(a[i] - b[i]) / double(a.size());
  EXPECT_LT(error, 0.03);
}

// An outer surface that lets all light through is not there; one that lets none through is all that
// is seen.
TEST_F(VolumePicture, TwoSurfaces) {
  const std::string ball = "volume volume:sphere?size=32 -q --size 48x48 ";
  // Both surfaces lie in the picture that the outer one is framed by.
  const std::string camera = "--eye 2.5,1.9,1.2 --look-at 0.5,0.5,0.5 ";
  const std::string two = ball + camera + "--iso 0.1 --outer-iso 0 --outer-colour 0,0.5,1 ";
  expect_success(two + "-o clear.png --outer-opacity 0");
  expect_success(two + "-o solid.png --outer-opacity 1");
  expect_success(two + "-o half.png --outer-opacity 0.5");
  expect_success(ball + camera + "-o inner.png --iso 0.1");
  expect_success(ball + camera + "-o outer.png --surface-colour 0,0.5,1");
  std::vector<Image> images(5);
  const char* files[5] = {"clear.png", "inner.png", "solid.png", "outer.png", "half.png"};
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(tools::read_image(path(files[i]), &images[i]).ok());
  int between = 0;
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < images[0].channels[0].values.size(); ++i) {
      float v[5];
      for (int m = 0; m < 5; ++m) v[m] = images[m].channels[k].values[i];
      EXPECT_NEAR(v[0], v[1], 1.01 / 255);
      EXPECT_NEAR(v[2], v[3], 1.01 / 255);
      EXPECT_GE(v[4], std::min(v[0], v[2]) - 1.01 / 255);
      EXPECT_LE(v[4], std::max(v[0], v[2]) + 1.01 / 255);
      between += std::abs(v[4] - v[0]) > 0.05 && std::abs(v[4] - v[2]) > 0.05;
    }
  }
  EXPECT_GT(between, 300);
  expect_failure(two + "-o below.png --solid below", 2,
                 "--outer-iso is 0; it must be greater than");
  expect_failure(ball + "-o a.png --outer-iso 0.1", 2, "less than the inner isovalue, 0");
  expect_failure(ball + "-o a.png --outer-iso -9", 2, "--outer-iso: isovalue is -9");
  expect_failure(ball + "-o a.png --outer-iso inf", 2, "a finite number");
  expect_failure(ball + "-o a.png --outer-opacity 0.5", 2, "needs --outer-iso");
  expect_failure(ball + "-o a.pfm --outer-iso -0.1", 2, "--light lit");
  expect_failure(ball + "-o a.png --outer-iso -0.1 --outer-opacity 2", 2, "--outer-opacity");
}

TEST_F(VolumePicture, BadUsage) {
  const std::string ball = "volume volume:sphere?size=8 ";
  expect_failure(ball + "-o a.pfm --light lit", 2, "--light lit makes a picture");
  expect_failure(ball + "-o a.png --light lit --outputs coverage", 2, "--light lit");
  expect_failure(ball + "-o a.png --light ao --surface-colour 1,1,1", 2, "--surface-colour");
  expect_failure(ball + "-o a.pfm --background-colour 1,1,1", 2, "--background-colour");
  expect_failure(ball + "-o a.png --surface-colour 1,1", 2, "each in [0, 1]");
  expect_failure(ball + "-o a.png --surface-colour 2,1,1", 2, "each in [0, 1]");
  expect_failure(ball + "-o a.png --gamma 0", 2, "--gamma is '0'");
  expect_failure(ball + "-o a.png --gamma 11", 2, "--gamma is 11; it must be in [0.1, 10]");
  for (const char* file : {"a.png", "a.pfm"}) {
    expect_failure(ball + "-o " + file + " --eye 5,5,5 --look-at 9,9,9", 2,
                   "misses the surface; --eye and --look-at must show a part of the volume");
  }
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
  EXPECT_FALSE(std::filesystem::exists(path("a.pfm")));
}

}  // namespace
}  // namespace obscura
