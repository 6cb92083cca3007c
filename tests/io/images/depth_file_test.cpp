#include "io/images/depth_file.h"

#include <cmath>

#include "io/images/describe.h"
#include "io/images/files.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

ExrHeader header_with(std::initializer_list<const char*> channels) {
  ExrHeader header;
  for (const char* name : channels) header.channels.push_back({name, "float"});
  return header;
}

TEST(ExrChannels, TheBestDepthNameWinsAndEqualsAreRefused) {
  struct Case {
    std::initializer_list<const char*> channels;
    const char* depth;  // "" where the choice is refused
  };
  for (const Case& c : {Case{{"Z", "depth.Z"}, "Z"},
                        {{"z"}, "z"},
                        {{"depth.V", "depth.Z"}, "depth.Z"},
                        {{"Depth.red", "Depth.green", "Depth.blue"}, "Depth.red"},
                        {{"Z.V"}, "Z.V"},
                        {{"View Layer.Depth.Z", "View Layer.Mist.Z"}, "View Layer.Depth.Z"},
                        {{"zDepth"}, "zDepth"},
                        {{"ZBack", "depth"}, "depth"},
                        {{"A.Depth.Z", "B.Depth.Z"}, ""},
                        {{"ZBack"}, ""},
                        {{"volume_Z", "R"}, ""}}) {
    ExrChannelChoice choice;
    const Status s = choose_exr_channels("x", header_with(c.channels), {}, &choice);
    EXPECT_EQ(s.ok(), *c.depth != 0) << *c.channels.begin() << " " << s.message();
    EXPECT_EQ(choice.depth, c.depth);
    if (s.ok()) continue;
    // What there is to choose from is said.
    EXPECT_NE(s.message().find(*c.channels.begin()), std::string::npos) << s.message();
  }
}

TEST(ExrChannels, BackDepthAndNormalsOfTheSameViewAreTaken) {
  ExrChannelChoice choice;
  DepthFileOptions o;
  o.depth_channel = "B.Depth.Z";
  const ExrHeader views =
      header_with({"A.Depth.Z", "A.DepthBack.Z", "A.Normal.X", "A.Normal.Y", "A.Normal.Z",
                   "B.Depth.Z", "B.DepthBack.Z", "B.Normal.X", "B.Normal.Y", "B.Normal.Z"});
  ASSERT_TRUE(choose_exr_channels("x", views, o, &choice).ok());
  EXPECT_EQ(choice.back_depth, "B.DepthBack.Z");
  EXPECT_EQ(choice.normals[0], "B.Normal.X");
  const Status s = choose_exr_channels(
      "x", header_with({"Z", "a.n.x", "a.n.y", "a.n.z", "b.N.R", "b.N.G", "b.N.B"}), {}, &choice);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find("(a.n.X, b.N.X)"), std::string::npos) << s.message();
  ASSERT_TRUE(choose_exr_channels("x", header_with({"Z", "NX", "NY", "NZ"}), {}, &choice).ok());
  EXPECT_EQ(choice.normals[2], "NZ");
  // Two of three are none.
  ASSERT_TRUE(choose_exr_channels("x", header_with({"Z", "N.X", "N.Y"}), {}, &choice).ok());
  EXPECT_EQ(choice.normals[0], "");
}

using Matrix = ExrHeader::Matrix;
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// Writes a depth image of 8x4 with matrices, and loads it.
struct MatrixTest : FilesTest {
  Status load(const Matrix& to_camera, const Matrix& to_ndc, const DepthFileOptions& options = {}) {
    ExrWriteOptions write;
    write.world_to_camera = to_camera;
    write.world_to_ndc = to_ndc;
    Image image = ramp(8, 4, {"Z", "N.X", "N.Y", "N.Z"});
    EXPECT_TRUE(write_exr(path("m.exr"), image, write).ok());
    return load_depth_input(path("m.exr"), options, &input);
  }
  DepthInput input;
};

// x' = 0.75 x / z + 0.5, y' = -1.5 y / z + 0.5: half the image is 0.667 z wide.
constexpr Matrix kToNdc{0.75, 0, 0, 0, 0, -1.5, 0, 0, 0.5, 0.5, 1, 1, 0, 0, 0, 0};

void expect_camera(const Camera& c, float u = 4, float v = 2) {
  EXPECT_FALSE(c.orthographic);
  EXPECT_NEAR(c.scale_x, 1 / (0.75 * 8), 1e-6);
  EXPECT_NEAR(c.scale_y, 1 / (1.5 * 4), 1e-6);
  EXPECT_NEAR(c.center_u, u, 1e-5);
  EXPECT_NEAR(c.center_v, v, 1e-5);
}

TEST_F(MatrixTest, NdcFromZeroToOneAndFromMinusOne) {
  ASSERT_TRUE(load(kIdentity, kToNdc).ok());
  expect_camera(input.camera);
  // The same view with (-1, -1) at the lower left corner.
  const Matrix screen{1.5, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0};
  ASSERT_TRUE(load(kIdentity, screen).ok());
  expect_camera(input.camera);
}

TEST_F(MatrixTest, ACameraThatLooksAlongMinusZ) {
  Matrix to_ndc = kToNdc;
  for (int i = 8; i < 12; ++i) to_ndc[i] = -to_ndc[i];
  ASSERT_TRUE(load(kIdentity, to_ndc).ok());
  expect_camera(input.camera);
  // World normals of such a camera are eye-space normals; with z forward, z is turned.
  DepthFileOptions o;
  o.normal_space = NormalSpace::kWorld;
  ASSERT_TRUE(load(kIdentity, to_ndc, o).ok());
  const float z = ramp(8, 4, {"Z", "N.X", "N.Y", "N.Z"}).channels[3].values[0];
  EXPECT_EQ(input.normal_z[0], z);
  ASSERT_TRUE(load(kIdentity, kToNdc, o).ok());
  EXPECT_EQ(input.normal_z[0], -z);
}

TEST_F(MatrixTest, AGuardBandInsideTheDisplayWindowDoesNotMoveTheCamera) {
  DepthFileOptions o;
  o.guard_band = GuardBandSpec{false, 2, 1};
  ASSERT_TRUE(load(kIdentity, kToNdc, o).ok());
  EXPECT_EQ(input.guard_band, GuardBand::symmetric(2, 1));
  expect_camera(input.camera);
}

TEST_F(MatrixTest, OptionsComeBeforeTheFile) {
  DepthFileOptions o;
  o.fov_y = 90;
  ASSERT_TRUE(load(kIdentity, kToNdc, o).ok());
  EXPECT_NEAR(input.camera.scale_y, 2.0 / 4, 1e-6);
}

TEST_F(MatrixTest, MatricesThatAreNoCameraAreRefused) {
  Matrix flat{}, mirrored = kToNdc, rolled = kToNdc, nan = kToNdc;
  mirrored[0] = -mirrored[0];
  rolled[1] = 0.4;
  nan[5] = NAN;
  for (const auto& [camera, ndc] : {std::pair{flat, kToNdc},
                                    {kIdentity, flat},
                                    {kIdentity, mirrored},
                                    {kIdentity, rolled},
                                    {kIdentity, nan}}) {
    const Status s = load(camera, ndc);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find("fov-y"), std::string::npos) << s.message();
  }
  DepthFileOptions o;
  o.fov_y = 90;
  EXPECT_TRUE(load(flat, kToNdc, o).ok());
}

TEST_F(FilesTest, NoCameraIsSaidWithWhatToGive) {
  ASSERT_TRUE(write_image(path("d.pfm"), ramp(4, 4, {"Y"})).ok());
  DepthInput input;
  const Status s = load_depth_input(path("d.pfm"), {}, &input);
  EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
  for (const char* option : {"fov-y", "ortho-height", "focal-length", "projection"}) {
    EXPECT_NE(s.message().find(option), std::string::npos) << s.message();
  }
  EXPECT_EQ(input.width, 0);  // untouched
  for (double bad : {0.0, -1.0, double{NAN}, double{INFINITY}}) {
    DepthFileOptions o;
    o.ortho_height = bad;
    EXPECT_EQ(load_depth_input(path("d.pfm"), o, &input).code(), StatusCode::kInvalidArgument);
    o = {};
    o.fov_y = bad;
    EXPECT_EQ(load_depth_input(path("d.pfm"), o, &input).code(), StatusCode::kInvalidArgument);
    o = {};
    o.focal_length = 35;
    o.sensor_height = bad;
    EXPECT_EQ(load_depth_input(path("d.pfm"), o, &input).code(), StatusCode::kInvalidArgument);
  }
}

TEST_F(FilesTest, PlanesComeFromTheProjection) {
  ASSERT_TRUE(write_image(path("d.pfm"), ramp(4, 4, {"Y"})).ok());
  struct Case {
    const char* matrix;
    DepthKind kind;
    float near, far;
  };
  // Near 0.5 and far 10 or infinity: n f / (f - n) = 0.526316, f / (f - n) = 1.052632.
  for (const Case& c :
       {Case{"1 0 0 0  0 1 0 0  0 0 -1.0526315789 -0.5263157895  0 0 -1 0", DepthKind::kNdc, 0.5f,
             10},
        {"1 0 0 0  0 1 0 0  0 0 -1 -0.5  0 0 -1 0", DepthKind::kNdc, 0.5f, INFINITY},
        {"1 0 0 0  0 1 0 0  0 0 0 0.5  0 0 -1 0", DepthKind::kNdcReversed, 0.5f, INFINITY},
        {"1 0 0 0  0 1 0 0  0 0 0.0526315789 0.5263157895  0 0 -1 0", DepthKind::kNdcReversed, 0.5f,
         10}}) {
    write("p.txt", c.matrix);
    DepthFileOptions o;
    o.projection = path("p.txt");
    o.depth_kind = static_cast<FileDepthKind>(c.kind);
    DepthInput input;
    const Status s = load_depth_input(path("d.pfm"), o, &input);
    ASSERT_TRUE(s.ok()) << s.message();
    EXPECT_NEAR(input.near_plane, c.near, 1e-5);
    if (std::isinf(c.far)) {
      EXPECT_EQ(input.far_plane, c.far);
    } else {
      EXPECT_NEAR(input.far_plane, c.far, 1e-3);
    }
    o.near = 0.25;  // one plane given, the other from the matrix
    ASSERT_TRUE(load_depth_input(path("d.pfm"), o, &input).ok());
    EXPECT_EQ(input.near_plane, 0.25f);
    // The other kind of depth does not go with this matrix.
    o.near = {};
    o.depth_kind = c.kind == DepthKind::kNdc ? FileDepthKind::kNdcReversed : FileDepthKind::kNdc;
    EXPECT_FALSE(load_depth_input(path("d.pfm"), o, &input).ok());
  }
}

TEST_F(FilesTest, EveryGuardBandInPerCentIsFoundAgain) {
  for (double per_cent : {1.0, 5.0, 10.0, 12.5, 33.0, 100.0}) {
    const GuardBandSpec spec{true, per_cent, per_cent};
    for (int visible : {1, 2, 3, 17, 97, 360, 641}) {
      const GuardBand expected = spec.resolve({visible, visible});
      const int side = visible + 2 * expected.left;
      ASSERT_TRUE(write_image(path("d.pfm"), ramp(side, side, {"Y"})).ok());
      DepthFileOptions o;
      o.fov_y = 60;
      o.guard_band = spec;
      DepthInput input;
      const Status s = load_depth_input(path("d.pfm"), o, &input);
      ASSERT_TRUE(s.ok()) << s.message();
      EXPECT_EQ(input.guard_band, expected) << per_cent << "% of " << visible;
    }
  }
}

TEST_F(FilesTest, ADisplayWindowFarBeyondTheDataIsRefused) {
  ExrWriteOptions options;
  options.display_window = PixelWindow{0, 0, 60000, 60000};
  ASSERT_TRUE(write_exr(path("a.exr"), ramp(4, 4, {"Z"}), options).ok());
  DepthFileOptions o;
  o.fov_y = 60;
  DepthInput input;
  EXPECT_EQ(load_depth_input(path("a.exr"), o, &input).code(), StatusCode::kInvalidInput);
  // A small part of an ordinary picture is fine: the rest is background.
  options.display_window = PixelWindow{-100, -50, 538, 309};
  ASSERT_TRUE(write_exr(path("a.exr"), ramp(4, 4, {"Z"}), options).ok());
  ASSERT_TRUE(load_depth_input(path("a.exr"), o, &input).ok());
  EXPECT_EQ(input.width, 639);
  EXPECT_TRUE(std::isnan(input.depth[0]));
  EXPECT_EQ(input.depth[50 * 639 + 100], 0.125f);
}

TEST_F(FilesTest, LayersAreReadAsFarAsTheFileHasThem) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(3, 3,
                                              {"Z", "layer1.Z", "layer1.ZBack", "layer2.Z",
                                               "layer2.ZBack", "layer3.Z"}))
                  .ok());
  DepthFileOptions o;
  o.fov_y = 60;
  DepthInput input;
  for (const auto& [asked, found] : {std::pair{0, 0u}, {1, 1u}, {5, 2u}}) {
    o.layers = asked;
    ASSERT_TRUE(load_depth_input(path("a.exr"), o, &input).ok());
    EXPECT_EQ(input.layers.size(), found);
  }
  EXPECT_EQ(input.layers[1].back[0], 0.125f * (1 + 4 * 9));
}

TEST_F(FilesTest, OneChannelMayServeTwice) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(3, 3, {"Z"})).ok());
  DepthFileOptions o;
  o.fov_y = 60;
  o.back_depth_channel = "Z";
  DepthInput input;
  ASSERT_TRUE(load_depth_input(path("a.exr"), o, &input).ok());
  EXPECT_EQ(input.depth, input.back_depth);
}

TEST_F(FilesTest, ADescriptionSaysWhatWouldBeUsed) {
  ExrWriteOptions options;
  options.display_window = PixelWindow{1, 1, 2, 2};
  Image image = ramp(4, 4, {"Depth.Z", "N.X", "N.Y", "N.Z"});
  image.channels[0].values[3] = INFINITY;
  ASSERT_TRUE(write_exr(path("a.exr"), image, options).ok());
  Json json;
  ASSERT_TRUE(describe_image(path("a.exr"), &json).ok());
  EXPECT_EQ(json["display_window"].dump(), "[1,1,2,2]");
  EXPECT_EQ(json["depth"].text(), "Depth.Z");
  EXPECT_EQ(json["normals"].text(), "N.X N.Y N.Z");
  EXPECT_EQ(json["channels"].elements()[0]["finite"].number(), 15);
  EXPECT_EQ(json["channels"].elements()[0]["min"].number(), 0.125);
  EXPECT_NE(json["camera"].text().find("fov-y"), std::string::npos);
  EXPECT_NE(description_text(json).find("Depth.Z"), std::string::npos);
}

TEST_F(MatrixTest, ADescriptionSaysTheFieldOfView) {
  ASSERT_TRUE(load(kIdentity, kToNdc).ok());
  Json json;
  ASSERT_TRUE(describe_image(path("m.exr"), &json).ok());
  // Half the height is 1/3 of depth: 2 atan(1/3) = 36.8699 degrees.
  EXPECT_NE(json["camera"].text().find("fov-y 36.8699"), std::string::npos);
}

TEST_F(FilesTest, NamesThatAreNoTextAreDescribed) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(2, 2, {"\x1b[2J\xff", "Z"})).ok());
  Json json;
  ASSERT_TRUE(describe_image(path("a.exr"), &json).ok());
  const std::string text = description_text(json);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("?[2J"), std::string::npos);
}

}  // namespace
}  // namespace obscura::tools
