#include <cmath>
#include <limits>

#include "tests/command/run_command.h"

// Unlucky values: one line that says what is wrong and what would be right.
namespace obscura {
namespace {

std::string floats(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

class MessagesTest : public CommandTest {
 protected:
  MessagesTest() {
    write("a.pfm", "Pf\n8 8\n-1\n" + floats(std::vector<float>(64, 3)));
    for (int i = 0; i < 512; ++i) ramp_.push_back(static_cast<float>(i));
    write("ok.nrrd", nrrd("1 1 1") + floats(ramp_));
  }
  static std::string nrrd(const std::string& spacings) {
    return "NRRD0004\ntype: float\ndimension: 3\nsizes: 8 8 8\nendian: little\nencoding: raw\n"
           "spacings: " +
           spacings + "\n\n";
  }
  std::vector<float> ramp_;
};

TEST_F(MessagesTest, Cameras) {
  expect_failure("ao a.pfm --fov-y 179.999999 -o o.pfm", 2, "[0.0001, 179.9]");
  expect_failure("ao a.pfm --fov-y 1e-30 -o o.pfm", 2, "[0.0001, 179.9]");
  expect_failure("ao a.pfm --fov-y nan -o o.pfm", 2, "fov-y");
  expect_failure("ao scene:cornell --fov-y 179.999999 -o o.pfm", 2, "[0.01, 179.9]");
  expect_failure("ao a.pfm --fov-y 60 --device -1 --backend vulkan -o o.pfm", 2, "0 to 65535");
}

TEST_F(MessagesTest, NoVulkanDriver) {
  const std::string none = "export VK_ICD_FILENAMES=/none VK_DRIVER_FILES=/none;";
  const CommandResult r = run("ao a.pfm --fov-y 60 --backend vulkan --method line -o o.pfm", none);
  EXPECT_EQ(r.code, 2) << r.err;
  EXPECT_EQ(r.err.find("(-"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("Vulkan"), std::string::npos) << r.err;
}

TEST_F(MessagesTest, Isovalues) {
  expect_failure("volume ok.nrrd --iso nan -o o.png", 2, "it must be a number");
  expect_failure("volume ok.nrrd --iso 9999 -o o.png", 2, "its values go from 0 to 511");
  expect_failure("volume ok.nrrd --iso -1 -o o.png", 2, "its values go from 0 to 511");
  write("nan.nrrd",
        nrrd("1 1 1") + floats(std::vector<float>(512, std::numeric_limits<float>::quiet_NaN())));
  expect_failure("volume nan.nrrd -o o.png", 3, "has no finite value");
  expect_failure("volume ok.nrrd --eye 100,100,100 --look-at 200,200,200 --iso 200 -o o.png", 2,
                 "misses the surface");
}

// A voxel whose surface no ray of a coarse picture meets; NaN is named only where there is some.
TEST_F(MessagesTest, SurfacesBetweenPixels) {
  std::vector<float> voxel(512, 0.0f);
  voxel[(3 * 8 + 4) * 8 + 4] = 100;
  write("voxel.nrrd", nrrd("1 1 1") + floats(voxel));
  const std::string line = "volume voxel.nrrd --iso 99.9 --size 4x4 -o o.png";
  expect_failure(line, 3, "a larger --size\n");
  voxel[0] = std::numeric_limits<float>::quiet_NaN();
  write("voxel.nrrd", nrrd("1 1 1") + floats(voxel));
  expect_failure(line, 3, "clip its NaN");
}

TEST_F(MessagesTest, PicturesOfNothing) {
  write("t.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
  const std::string line = "ao t.obj --eye 0,0,3 --size 16x16 -q -o o.pfm --look-at ";
  const CommandResult away = run(line + "0,0,9");
  EXPECT_EQ(away.code, 0);
  EXPECT_NE(away.err.find("shows nothing of t.obj"), std::string::npos) << away.err;
  expect_success(line + "0,0,0");
}

TEST_F(MessagesTest, MessagesAreUtf8WithoutControls) {
  const CommandResult r = run("info 'n\xC3\xA9\xC2\x9B\xFFx.exr'");
  EXPECT_EQ(r.code, 3);
  EXPECT_NE(r.err.find("n\xC3\xA9???x.exr"), std::string::npos) << r.err;
  // A slash spelt in three bytes, half of a pair, beyond the last character; and the last one.
  const CommandResult odd =
      run("info 'a\xE0\x80\xAF"
          "b\xED\xA0\x80"
          "c\xF4\x90\x80\x80"
          "d\xF4\x8F\xBF\xBF.exr'");
  EXPECT_NE(odd.err.find("a???b???c????d\xF4\x8F\xBF\xBF.exr"), std::string::npos) << odd.err;
}

TEST_F(MessagesTest, Spacings) {
  for (const char* spacings : {"0 1 1", "1e-30 1 1", "1 1 1e30", "inf 1 1"}) {
    write("s.nrrd", nrrd(spacings) + floats(ramp_));
    expect_failure("volume s.nrrd --iso 200 -o o.png", 3, "spacing");
  }
  write("r.raw", floats(ramp_));
  const std::string raw = "volume r.raw --raw-size 8x8x8 --raw-type f32 --iso 200 -o o.exr ";
  expect_failure(raw + "--raw-spacing 1e-30,1,1e30", 2, "three numbers in [1e-12, 1e12]");
  expect_failure(raw + "--raw-spacing 0,1,1", 2, "three numbers in [1e-12, 1e12]");
  expect_failure(raw + "--raw-spacing 1,nan,1", 2, "three numbers in [1e-12, 1e12]");
  // A grid of cubes that is turned to the light grows with the square of the spacings' ratio.
  expect_failure(raw + "--raw-spacing 1,1,1000 --light shadow:0,0,-1", 2, "more alike",
                 address_limit() + "timeout 10");
  EXPECT_EQ(run(raw + "--raw-spacing 1,1,3 --light shadow:0,0,-1 -q").code, 0);
}

}  // namespace
}  // namespace obscura
