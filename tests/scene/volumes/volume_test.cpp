#include <cmath>

#include "scene/volumes/histogram.h"
#include "tests/scene/volumes/volume_files.h"

namespace obscura::tools {
namespace {

using VolumeTest = VolumeFileTest;

TEST_F(VolumeTest, RawNeedsItsExactSize) {
  RawLayout layout;
  layout.size = {3, 2, 1};
  layout.type = VoxelType::kU16;
  layout.spacing = {1, 2, 3};
  const auto bytes = bytes_of_values<std::uint16_t>({1, 2, 3, 4, 5, 600});
  VolumeImage image;
  ASSERT_TRUE(load_volume(write("a.raw", bytes), layout, &image).ok());
  EXPECT_EQ(value_at(image, 2, 1, 0), 600);
  EXPECT_EQ(image.spacing(), layout.spacing);
  expect_refused(write("b.raw", bytes + "x"), "need exactly 12", layout);
  expect_refused(path("a.raw"), "give its size");
  layout.size = {8192, 8192, 8192};
  expect_refused(path("a.raw"), "need exactly", layout);
  layout.size = {1 << 30, 1 << 30, 1 << 30};
  expect_refused(path("a.raw"), "must be in [1, 8192]", layout);
  layout.size = {3, 2, 1};
  layout.big_endian = true;
  ASSERT_TRUE(load_volume(path("a.raw"), layout, &image).ok());
  EXPECT_EQ(value_at(image, 0, 0, 0), 256);
}

TEST_F(VolumeTest, EndingsAreChecked) {
  expect_refused(write("a.txt", "x"), "is not a volume by its name");
  expect_refused(write("a.gz", "x"), "is not a volume by its name");
  EXPECT_TRUE(is_volume("volume:sphere"));
  EXPECT_TRUE(is_volume("/x/Y.NII.GZ"));
  EXPECT_FALSE(is_volume("depth.exr"));
}

TEST_F(VolumeTest, ClipKeepsTheWorld) {
  VolumeImage image, whole;
  ASSERT_TRUE(load_volume("volume:sphere?size=16", {}, &whole).ok());
  image = whole;
  ClipBox box;
  ASSERT_TRUE(parse_clip("2:9,:7,5:", &box).ok());
  ASSERT_TRUE(clip(box, &image).ok());
  EXPECT_EQ(image.size, (std::array{8, 8, 11}));
  EXPECT_EQ(value_at(image, 1, 2, 3), value_at(whole, 3, 2, 8));
  const double h = whole.spacing()[0];
  EXPECT_NEAR(image.to_world({h, 2 * h, 3 * h})[0], whole.to_world({3 * h, 2 * h, 8 * h})[0],
              1e-12);
  for (const char* bad : {"", "1:2", "1:2,3:4", "1:2,3:4,5:6,7:8", "a:2,3:4,5:6", "-1:2,:,:"}) {
    EXPECT_FALSE(parse_clip(bad, &box).ok()) << bad;
  }
  for (const char* outside : {"0:16,:,:", "9:8,:,:", "20:,:,:"}) {
    ASSERT_TRUE(parse_clip(outside, &box).ok());
    VolumeImage copy = whole;
    EXPECT_EQ(clip(box, &copy).code(), StatusCode::kInvalidArgument) << outside;
    EXPECT_EQ(copy.size, whole.size);
  }
}

TEST_F(VolumeTest, ProceduralVolumes) {
  for (const char* name : {"gyroid", "sphere", "sphere-over-plane", "pillars", "cup", "open-box",
                           "vessels", "cloud"}) {
    const std::string spec = std::string("volume:") + name + "?size=24";
    VolumeImage a, b, c;
    ASSERT_TRUE(load_volume(spec, {}, &a).ok()) << spec;
    ASSERT_TRUE(load_volume(spec, {}, &b).ok());
    ASSERT_TRUE(load_volume(spec + "&seed=7", {}, &c).ok());
    EXPECT_EQ(a.samples, b.samples) << spec;
    const bool random = a.samples != c.samples;
    EXPECT_EQ(random, name == std::string("pillars") || name == std::string("vessels") ||
                          name == std::string("cloud"))
        << spec;
    VolumeRange range;
    ASSERT_TRUE(volume_range(a.view(), &range).ok());
    EXPECT_EQ(range.not_finite, 0) << spec;
    EXPECT_LT(range.min, 0) << spec;
    EXPECT_GT(range.max, 0) << spec;
    EXPECT_EQ(a.isovalue, 0.0f);
  }
  // The sphere of radius 0.3 around the middle: matter is positive.
  VolumeImage sphere;
  ASSERT_TRUE(load_volume("volume:sphere?size=10", {}, &sphere).ok());
  EXPECT_NEAR(value_at(sphere, 5, 5, 5), 0.3 - 0.05 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(value_at(sphere, 0, 5, 5), 0.3 - std::hypot(0.45, 0.05, 0.05), 1e-6);
  expect_refused("volume:cube", "there is no volume");
  expect_refused("volume:sphere?size=0", "size");
  expect_refused("volume:sphere?width=4", "no key \"width\"");
}

VolumeImage of_values(std::vector<float> values) {
  VolumeImage image;
  image.name = "values";
  image.size = {int(values.size()), 1, 1};
  image.samples.resize(values.size() * sizeof(float));
  std::memcpy(image.samples.data(), values.data(), image.samples.size());
  return image;
}

TEST_F(VolumeTest, OtsuPartsTwoHeaps) {
  VolumeImage image = of_values({1, 1.1f, 0.9f, 1, 5, 5.1f, 4.9f, NAN, INFINITY});
  Histogram h;
  ASSERT_TRUE(make_histogram(image, &h).ok());
  EXPECT_EQ(h.nan, 1);
  EXPECT_EQ(h.infinite, 1);
  EXPECT_EQ(h.finite, 7);
  double threshold = 0;
  ASSERT_TRUE(otsu_threshold(image, h, &threshold).ok());
  EXPECT_NEAR(threshold, 3, 0.05);  // the middle of the gap
}

TEST_F(VolumeTest, OtsuOfWholeNumbersLiesBetweenThem) {
  VolumeImage image;
  image.type = VoxelType::kU8;
  image.size = {4, 1, 1};
  for (int v : {3, 3, 4, 4}) image.samples.push_back(std::byte(v));
  image.slope = 2;
  Histogram h;
  ASSERT_TRUE(make_histogram(image, &h).ok());
  EXPECT_EQ(h.bins, (std::vector<std::int64_t>{2, 2}));
  double threshold = 0;
  ASSERT_TRUE(otsu_threshold(image, h, &threshold).ok());
  EXPECT_EQ(threshold, 7);
}

TEST_F(VolumeTest, NothingToPart) {
  Histogram h;
  double threshold = 0;
  VolumeImage flat = of_values({2, 2, 2});
  ASSERT_TRUE(make_histogram(flat, &h).ok());
  EXPECT_FALSE(otsu_threshold(flat, h, &threshold).ok());
  EXPECT_FALSE(make_histogram(of_values({NAN, NAN}), &h).ok());
}

TEST_F(VolumeTest, Described) {
  Json d;
  ASSERT_TRUE(describe_volume("volume:sphere?size=8", {}, &d).ok());
  EXPECT_EQ(d["kind"].text(), "volume");
  EXPECT_EQ(d["size"].dump(), "[8,8,8]");
  double sum = 0;
  for (const Json& n : d["histogram"]["counts"].elements()) sum += n.number();
  EXPECT_EQ(sum, 512);
  const std::string text = volume_description_text(d);
  EXPECT_NE(text.find("8x8x8 voxels of f32"), std::string::npos) << text;
  EXPECT_NE(text.find("Otsu"), std::string::npos);
}

}  // namespace
}  // namespace obscura::tools
