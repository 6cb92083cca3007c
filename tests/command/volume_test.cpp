#include <cmath>

#include "io/images/files.h"
#include "io/volumes/vdb.h"
#include "scene/truth/compare.h"
#include "scene/volumes/load_volume.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

using tools::Image;
using VolumeCommand = CommandTest;

TEST_F(VolumeCommand, PicturesOfEveryLight) {
  for (const char* light :
       {"ao", "headlight", "octants:4,5,6,7", "octants:upper", "shadow:1,1,2", "translucent:0.5"}) {
    expect_success(std::string("volume volume:sphere-over-plane?size=24 --size 40x30 -q -o a.pfm "
                               "--light ") +
                   light);
    tools::Image image;
    ASSERT_TRUE(tools::read_image(path("a.pfm"), &image).ok());
    EXPECT_EQ(image.width, 40);
    EXPECT_EQ(image.height, 30);
    EXPECT_EQ(image.channels[0].values[0], 1);  // background
    float least = 1;
    for (float v : image.channels[0].values) {
      EXPECT_TRUE(v >= 0 && v <= 1) << light;
      least = std::min(least, v);
    }
    EXPECT_LT(least, 0.9f) << light;
  }
}

TEST_F(VolumeCommand, MonteCarloAgreesWithTheSweep) {
  const std::string volume = "volume volume:cup?size=40 --size 48x48 -q ";
  expect_success(volume + "-o sweep.exr --outputs visibility,coverage,depth --json sweep.json");
  expect_success(volume + "-o rays.exr --method monte-carlo --rays 64");
  tools::Image sweep, rays;
  ASSERT_TRUE(tools::read_image(path("sweep.exr"), &sweep).ok());
  ASSERT_TRUE(tools::read_image(path("rays.exr"), &rays).ok());
  const auto& a = sweep.find("visibility")->values;
  const auto& b = rays.find("visibility")->values;
  double error = 0;
  for (std::size_t i = 0; i < a.size(); ++i) error += std::abs(a[i] - b[i]) / double(a.size());
  EXPECT_LT(error, 0.05);
  EXPECT_NE(sweep.find("coverage"), nullptr);
  EXPECT_NE(sweep.find("depth"), nullptr);
  EXPECT_NE(read_file(path("sweep.json")).find("time to render"), std::string::npos);
}

// The default sweep against rays kept in the repository (tests/truth/make.sh).
TEST_F(VolumeCommand, SweepMeetsItsErrorBar) {
  expect_success(
      "volume volume:gyroid --size 64x64 --samples-per-pixel 1 -o sweep.exr "
      "--eye 1.794695767540157,2.8539923046184668,1.55929653707831 --look-at 0.5,0.5,0.5");
  Image sweep, truth;
  ASSERT_TRUE(tools::read_image(path("sweep.exr"), &sweep).ok());
  ASSERT_TRUE(tools::read_image(OBSCURA_SOURCE_DIR "/tests/truth/gyroid.exr", &truth).ok());
  tools::Comparison c;
  ASSERT_TRUE(tools::compare(sweep.view(0), truth.view(0), {}, &c).ok());
  EXPECT_LE(c.e_a, 0.6);
  EXPECT_GE(c.correlation, 0.995);
}

TEST_F(VolumeCommand, IsovalueIsChosenAndSaid) {
  std::string bytes(512, '\0');
  for (int i = 0; i < 256; ++i) bytes[std::size_t(i)] = 100;
  write("a.raw", bytes);
  const CommandResult r = run("volume a.raw --raw-size 8x8x8 --size 16x16 -o a.png");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("isovalue 50 (Otsu's threshold"), std::string::npos) << r.out;
  expect_failure("volume a.raw --raw-size 8x8x8 --iso 200 -o b.png", 2,
                 "--iso: isovalue is 200, which does not cut the volume; its values go from 0 to "
                 "100");
  EXPECT_FALSE(std::filesystem::exists(path("b.png")));
  const CommandResult info = run("info a.raw --raw-size 8x8x8");
  EXPECT_NE(info.out.find("Otsu's threshold 50"), std::string::npos) << info.out << info.err;
}

TEST_F(VolumeCommand, FieldsAreVolumes) {
  expect_success(
      "volume volume:sphere?size=16 -q --fields d.nrrd --fields-of distance --clip 2:13,:,:");
  tools::VolumeImage image;
  ASSERT_TRUE(tools::load_volume(path("d.nrrd"), {}, &image).ok());
  EXPECT_EQ(image.size, (std::array{12, 16, 16}));
  EXPECT_NEAR(image.origin[0], 2.5 / 16, 1e-6);
  expect_success("volume volume:sphere?size=16 -q --fields v.nrrd --fields-of scalar");
  ASSERT_TRUE(tools::load_volume(path("v.nrrd"), {}, &image).ok());
  if (tools::has_openvdb()) {
    expect_success("volume volume:sphere?size=16 -q --fields v.vdb");
    ASSERT_TRUE(tools::load_volume(path("v.vdb"), {}, &image).ok());
  }
}

TEST_F(VolumeCommand, OctantsAreNamed) {
  expect_success("volume volume:sphere?size=16 -q --fields v.nrrd");
  const std::string header = read_file(path("v.nrrd")).substr(0, 1000);
  for (int s = 0; s < 8; ++s) {
    const std::string name =
        "field " + std::to_string(s) + ":=visibility_octant_" + std::to_string(s) + "\n";
    EXPECT_NE(header.find(name), std::string::npos) << header;
  }
}

// Half of the voxels are NaN, and one axis has one voxel: a picture all the same.
TEST_F(VolumeCommand, HolesAndThinVolumes) {
  std::vector<float> values(12 * 12);
  for (int i = 0; i < 144; ++i)
    values[std::size_t(i)] = i % 12 < 6 ? NAN : i / 12 < 5 ? 1.0f : 0.0f;
  write("a.raw", std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size()));
  expect_success(
      "volume a.raw --raw-size 12x12x1 --raw-type f32 --iso 0.5 --size 24x24 -q -o a.pfm");
  tools::Image image;
  ASSERT_TRUE(tools::read_image(path("a.pfm"), &image).ok());
  for (float v : image.channels[0].values) EXPECT_TRUE(v >= 0 && v <= 1);
  std::fill(values.begin(), values.end(), NAN);
  write("b.raw", std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size()));
  expect_failure("volume b.raw --raw-size 12x12x1 --raw-type f32 --iso 0.5 -o b.png", 3,
                 "no finite voxel");
  // Matter of single voxels among NaN has no surface to see.
  values[70] = 1;
  values[71] = 0;
  write("c.raw", std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size()));
  expect_failure(
      "volume c.raw --raw-size 12x12x1 --raw-type f32 --iso 1 -o b.png", 3,
      "lies between the pixels; choose another --iso or a larger --size, or clip its NaN");
  for (const char* spacing : {"0,1,1", "1e-30,1,1", "nan,1,1"}) {
    expect_failure(
        std::string("volume c.raw --raw-size 24x24x1 --raw-spacing ") + spacing + " -o b.png",
        spacing[0] == '1' ? 3 : 2, "spacing");
  }
}

TEST_F(VolumeCommand, BadUsageAndInput) {
  const std::string ball = "volume volume:sphere?size=8 ";
  expect_failure(ball, 2, "nothing to write");
  expect_failure(ball + "-o a.txt", 2, "a.txt");
  expect_failure(ball + "-o a.png --light neon", 2, "--light is 'neon'");
  expect_failure(ball + "-o a.png --light octants:8", 2, "--light");
  expect_failure(ball + "-o a.png --light shadow:0,0,0", 2, "--light");
  expect_failure(ball + "-o a.png --light translucent:2", 2, "--light");
  expect_failure(ball + "-o a.pfm --gamma 2", 2, "--gamma");
  expect_failure(ball + "-o a.png --outputs depth", 2, "depth");
  expect_failure(ball + "-o a.png --outputs visibility,depth", 2, "one result");
  expect_failure(ball + "-o a.png --rays 5", 2, "monte-carlo");
  expect_failure(ball + "-o a.png --method monte-carlo --light headlight", 2, "monte-carlo");
  expect_failure(ball + "-o a.png --clip 1:2", 2, "clip");
  expect_failure(ball + "-o a.png --clip 0:8,:,:", 2, "clip");
  expect_failure(ball + "-o a.png --raw-size 2x2x2", 2, "raw");
  expect_failure(ball + "-o a.png --raw-type u8", 2, "--raw-size");
  expect_failure(ball + "-o a.png --ortho-height 2 --fov-y 30", 2, "fov-y");
  expect_failure(ball + "-o a.png --eye 1,1,1 --look-at 1,1,1", 2, "apart");
  expect_failure(ball + "--fields a.txt", 2, "--fields");
  expect_failure(ball + "--fields a.nrrd --light headlight", 2, "--fields");
  expect_failure("volume none.nii -o a.png", 3, "none.nii");
  expect_failure("volume none.txt -o a.png", 3, "by its name");
  expect_failure(ball + "-o /none/a.png", 1, "/none/a.png");
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

}  // namespace
}  // namespace obscura
