#include "io/images/files.h"

#include <png.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "io/images/depth_file.h"
#include "io/images/exr.h"
#include "io/images/hdr.h"
#include "io/images/pfm.h"
#include "io/images/png.h"
#include "scene/views/gbuffer_file.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

TEST_F(FilesTest, PfmRowsRunFromTheBottomInEitherByteOrder) {
  const float values[] = {1, 2, 3, 4};
  std::string little = "Pf\n2 2\n-1\n", big = "Pf\n2 2\n1.0\n";
  for (float v : values) {
    char b[4];
    std::memcpy(b, &v, 4);
    little.append(b, 4);
    std::swap(b[0], b[3]);
    std::swap(b[1], b[2]);
    big.append(b, 4);
  }
  for (const std::string& bytes : {little, big}) {
    Image image;
    ASSERT_TRUE(decode_pfm(bytes, "x", &image).ok());
    EXPECT_EQ(image.view(0)(0, 0), 3);  // the last row stored is the top one
    EXPECT_EQ(image.view(0)(1, 1), 2);
  }
}

TEST_F(FilesTest, PfmReadsBackWhatWasWritten) {
  for (const Image& image : {ramp(3, 2, {"Y"}), ramp(2, 5, {"R", "G", "B"})}) {
    std::string bytes;
    ASSERT_TRUE(encode_pfm(image, &bytes).ok());
    Image again;
    ASSERT_TRUE(decode_pfm(bytes, "x", &again).ok());
    ASSERT_EQ(again.channels.size(), image.channels.size());
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      EXPECT_EQ(again.channels[c].values, image.channels[c].values);
    }
  }
}

TEST_F(FilesTest, DamagedPfmIsRefusedWithoutAllocating) {
  for (const char* bytes : {"", "P", "PF", "Pf\n2", "Pf\n2 2\n", "Pf\n2 2\nnan\n", "Pf\n2 2\n0\n",
                            "Pf\n-2 2\n-1\n", "Pf\n65535 65535\n-1\nabcd",
                            "Pf\n99999999999 1\n-1\n", "Pf\n2 2\n-1\nshort", "P6\n2 2\n255\n"}) {
    Image image;
    EXPECT_EQ(decode_pfm(bytes, "x", &image).code(), StatusCode::kInvalidInput) << bytes;
  }
}

TEST_F(FilesTest, PngRoundsAndClamps) {
  Image image(5, 1);
  image.add("Y") = {0, 1, 0.5f, 7, NAN};
  ASSERT_TRUE(write_image(path("a.png"), image).ok());
  Image again;
  ASSERT_TRUE(read_image(path("a.png"), &again).ok());
  const float expected[] = {0, 1, 128 / 255.0f, 1, 0};
  for (int x = 0; x < 5; ++x) EXPECT_NEAR(again.view(0)(x, 0), expected[x], 1e-4);
}

// 16-bit grey rows, big-endian, by libpng.
std::string png16(int width, int height, const std::vector<std::uint16_t>& values) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, png_size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), size);
      },
      nullptr);
  png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int y = 0; y < height; ++y) {
    std::vector<png_byte> row;
    for (int x = 0; x < width; ++x) {
      row.push_back(values[y * width + x] >> 8);
      row.push_back(values[y * width + x] & 255);
    }
    png_write_row(png, row.data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

TEST_F(FilesTest, SixteenBitPngIsDepthBetweenNearAndFar) {
  write("d.png", png16(3, 1, {0, 13107, 65535}));
  DepthFileOptions o;
  o.fov_y = 60;
  DepthInput input;
  EXPECT_EQ(load_depth_input(path("d.png"), o, &input).code(), StatusCode::kInvalidArgument);
  o.near = 2;
  o.far = 12;
  ASSERT_TRUE(load_depth_input(path("d.png"), o, &input).ok());
  EXPECT_FLOAT_EQ(input.depth[0], 2);
  EXPECT_NEAR(input.depth[1], 4, 1e-4);
  EXPECT_TRUE(std::isnan(input.depth[2]));
  ASSERT_TRUE(write_image(path("eight.png"), ramp(2, 2, {"Y"})).ok());
  EXPECT_FALSE(load_depth_input(path("eight.png"), o, &input).ok());
}

TEST_F(FilesTest, RadianceIsReadAndDamageRefused) {
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  const unsigned char pixels[] = {128, 64, 32, 129, 128, 128, 128, 130};
  hdr.append(reinterpret_cast<const char*>(pixels), sizeof(pixels));
  Image image;
  ASSERT_TRUE(decode_hdr(hdr, "x", &image).ok());
  EXPECT_FLOAT_EQ(image.view(0)(0, 0), 1);
  EXPECT_FLOAT_EQ(image.view(1)(0, 0), 0.5f);
  EXPECT_FLOAT_EQ(image.view(2)(1, 0), 2);
  EXPECT_FALSE(decode_hdr(hdr.substr(0, 20), "x", &image).ok());
  EXPECT_FALSE(decode_hdr("nothing", "x", &image).ok());
}

TEST_F(FilesTest, ExrKeepsNamesWindowsAndValues) {
  const Image image = ramp(6, 4, {"Z", "a.b.C"});
  ExrWriteOptions options;
  options.display_window = PixelWindow{0, 0, 2, 2};
  options.data_window = PixelWindow{-1, 0, 4, 3};
  ASSERT_TRUE(write_exr(path("a.exr"), image, options).ok());
  ExrHeader header;
  Image again;
  ASSERT_TRUE(read_exr(path("a.exr"), {}, &header, &again).ok());
  EXPECT_EQ(header.display_window, *options.display_window);
  EXPECT_EQ(header.data_window, *options.data_window);
  ASSERT_NE(again.find("a.b.C"), nullptr);
  EXPECT_EQ(again.find("a.b.C")->values, image.channels[1].values);
  ASSERT_TRUE(read_exr(path("a.exr"), {"Z"}, &header, &again).ok());
  EXPECT_EQ(again.channels.size(), 1u);
}

TEST_F(FilesTest, HalfExrRoundsToHalf) {
  Image image(1, 1);
  image.add("v")[0] = 0.1f;
  ASSERT_TRUE(write_image(path("h.exr"), image, {.half = true}).ok());
  ExrHeader header;
  Image again;
  ASSERT_TRUE(read_exr(path("h.exr"), {}, &header, &again).ok());
  EXPECT_EQ(header.channels[0].type, "half");
  EXPECT_NEAR(again.view(0)(0, 0), 0.1, 1e-4);
  EXPECT_NE(again.view(0)(0, 0), 0.1f);
}

TEST_F(FilesTest, AnUnevenGuardBandComesFromTheWindowsAndHolesAreBackground) {
  ExrWriteOptions options;
  options.display_window = PixelWindow{0, 0, 3, 3};
  options.data_window =
      PixelWindow{-2, 1, 4, 5};  // 2 left, 1 right, 2 below, one row missing above
  ASSERT_TRUE(write_exr(path("a.exr"), ramp(7, 5, {"depth.Z"}), options).ok());
  DepthFileOptions o;
  o.fov_y = 90;
  DepthInput input;
  ASSERT_TRUE(load_depth_input(path("a.exr"), o, &input).ok());
  EXPECT_EQ(input.guard_band, (GuardBand{2, 1, 0, 2}));
  EXPECT_EQ(input.width, 7);
  EXPECT_EQ(input.height, 6);
  EXPECT_TRUE(std::isnan(input.depth[3]));
  EXPECT_EQ(input.depth[7], 0.125f);
  EXPECT_EQ(input.camera.center_u, 4);
  EXPECT_EQ(input.camera.center_v, 2);
  o.guard_band = GuardBandSpec{false, 1, 1};
  EXPECT_FALSE(load_depth_input(path("a.exr"), o, &input).ok());
}

TEST_F(FilesTest, GuardBandInPerCentIsOfTheVisibleSize) {
  Image image(768, 432);
  for (float& v : image.add("Y")) v = 1;
  ASSERT_TRUE(write_image(path("d.pfm"), image).ok());
  DepthFileOptions o;
  o.fov_y = 60;
  o.guard_band = GuardBandSpec{true, 10, 10};
  DepthInput input;
  ASSERT_TRUE(load_depth_input(path("d.pfm"), o, &input).ok());
  EXPECT_EQ(input.guard_band, GuardBand::symmetric(64, 36));
}

TEST_F(FilesTest, DepthChannelsAreFoundByName) {
  struct Case {
    std::initializer_list<const char*> channels;
    const char* depth;  // "" where the choice is refused
  };
  for (const Case& c : {Case{{"R", "G", "B", "Z"}, "Z"},
                        {{"depth.Z", "N.X", "N.Y", "N.Z"}, "depth.Z"},
                        {{"Depth.V"}, "Depth.V"},
                        {{"ViewLayer.Depth.Z", "ViewLayer.Combined.R"}, "ViewLayer.Depth.Z"},
                        {{"VRayZDepth.R", "VRayZDepth.G", "VRayZDepth.B"}, "VRayZDepth.R"},
                        {{"P.X", "P.Y", "P.Z"}, ""},
                        {{"Normal.X", "Normal.Y", "Normal.Z"}, ""},
                        {{"a.depth", "b.depth"}, ""},
                        {{"R", "G", "B"}, ""}}) {
    ExrHeader header;
    for (const char* name : c.channels) header.channels.push_back({name, "float"});
    ExrChannelChoice choice;
    const Status s = choose_exr_channels("x", header, {}, &choice);
    EXPECT_EQ(s.ok(), *c.depth != 0) << c.depth << s.message();
    EXPECT_EQ(choice.depth, c.depth);
  }
}

TEST_F(FilesTest, NormalsAreFoundByName) {
  ExrHeader header;
  for (const char* name : {"Z", "ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z",
                           "P.X", "P.Y", "P.Z"}) {
    header.channels.push_back({name, "float"});
  }
  ExrChannelChoice choice;
  ASSERT_TRUE(choose_exr_channels("x", header, {}, &choice).ok());
  EXPECT_EQ(choice.normals[1], "ViewLayer.Normal.Y");
  DepthFileOptions o;
  o.normals = "P";
  ASSERT_TRUE(choose_exr_channels("x", header, o, &choice).ok());
  EXPECT_EQ(choice.normals[2], "P.Z");
  o.normals = "none";
  ASSERT_TRUE(choose_exr_channels("x", header, o, &choice).ok());
  EXPECT_EQ(choice.normals[0], "");
  o.normals = "Q";
  EXPECT_FALSE(choose_exr_channels("x", header, o, &choice).ok());
}

// A G-buffer file with world-space normals must give the eye-space normals back.
TEST_F(FilesTest, CameraAndWorldNormalsSurviveTheFile) {
  for (const bool orthographic : {false, true}) {
    ViewSpec view;
    view.width = 32;
    view.height = 20;
    view.guard_band = {3, 4, 5, 6};
    view.eye = {1, 2, 3};
    view.look_at = {-1, 0.5, 0};
    view.orthographic = orthographic;
    view.ortho_height = 3;
    DepthInput input;
    input.width = view.full_width();
    input.height = view.full_height();
    input.camera = view.camera();
    input.guard_band = view.guard_band;
    const std::size_t n = static_cast<std::size_t>(input.width) * input.height;
    input.depth.assign(n, 2);
    const Vec3 eye_normal = normalize({0.3, -0.2, 0.9});
    const Vec3 world = view.frame().to_world(eye_normal);
    input.normal_x.assign(n, static_cast<float>(world.x));
    input.normal_y.assign(n, static_cast<float>(world.y));
    input.normal_z.assign(n, static_cast<float>(world.z));
    ASSERT_TRUE(write_gbuffer(path("g.exr"), input, view, false).ok());
    DepthFileOptions o;
    o.normal_space = NormalSpace::kWorld;
    DepthInput again;
    const Status s = load_depth_input(path("g.exr"), o, &again);
    ASSERT_TRUE(s.ok()) << s.message();
    EXPECT_EQ(again.guard_band, input.guard_band);
    EXPECT_EQ(again.camera.orthographic, orthographic);
    EXPECT_NEAR(again.camera.scale_x, input.camera.scale_x, 1e-6);
    EXPECT_NEAR(again.camera.scale_y, input.camera.scale_y, 1e-6);
    EXPECT_NEAR(again.camera.center_u, input.camera.center_u, 1e-3);
    EXPECT_NEAR(again.camera.center_v, input.camera.center_v, 1e-3);
    EXPECT_NEAR(again.normal_x[5], eye_normal.x, 1e-5);
    EXPECT_NEAR(again.normal_y[5], eye_normal.y, 1e-5);
    EXPECT_NEAR(again.normal_z[5], eye_normal.z, 1e-5);
  }
}

TEST_F(FilesTest, DamagedExrIsRefused) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(64, 64, {"Z"})).ok());
  std::string bytes;
  ASSERT_TRUE(read_bytes(path("a.exr"), &bytes).ok());
  Image image;
  for (std::size_t keep : {std::size_t{4}, std::size_t{100}, bytes.size() / 2, bytes.size() - 9}) {
    write("cut.exr", bytes.substr(0, keep));
    EXPECT_EQ(read_image(path("cut.exr"), &image).code(), StatusCode::kInvalidInput) << keep;
  }
  // A header that claims 60000 x 60000 pixels.
  std::string lying = bytes;
  const std::size_t at = lying.find("dataWindow");
  const std::int32_t far_corner[] = {59999, 59999};
  std::memcpy(lying.data() + at + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4 + 8,
              far_corner, sizeof(far_corner));
  write("lying.exr", lying);
  EXPECT_EQ(read_image(path("lying.exr"), &image).code(), StatusCode::kInvalidInput);
}

TEST_F(FilesTest, AFailedWriteKeepsTheOldFile) {
  write("old.pfm", "old");
  EXPECT_FALSE(write_image(path("old.pfm"), ramp(2, 2, {"a", "b"})).ok());
  std::string bytes;
  ASSERT_TRUE(read_bytes(path("old.pfm"), &bytes).ok());
  EXPECT_EQ(bytes, "old");
  EXPECT_FALSE(write_image(path("nowhere/x.pfm"), ramp(2, 2, {"a"})).ok());
  EXPECT_FALSE(write_image(path("old.pfm/x.pfm"), ramp(2, 2, {"a"})).ok());
  std::filesystem::create_directory(path("folder.pfm"));
  EXPECT_FALSE(write_image(path("folder.pfm"), ramp(2, 2, {"a"})).ok());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);
}

}  // namespace
}  // namespace obscura::tools
