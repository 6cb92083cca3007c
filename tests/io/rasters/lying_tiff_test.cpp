#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "io/rasters/gdal.h"

// GeoTIFFs whose header does not say the truth.
namespace obscura::tools {
namespace {

class LyingTiff : public testing::Test {
 protected:
  struct Tag {
    std::uint16_t number, type;  // 3: 16 bits, 4: 32 bits
    std::uint32_t count, value;
  };
  static constexpr int kWidth = 12, kHeight = 9;

  void SetUp() override {
    if (!has_gdal()) GTEST_SKIP() << "this build has no GDAL";
    std::string pattern = (std::filesystem::temp_directory_path() / "obscura-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  // Floats of one strip: header, data, directory. The tags that are true.
  static std::vector<Tag> tags() {
    return {{256, 4, 1, kWidth}, {257, 4, 1, kHeight}, {258, 3, 1, 32},
            {259, 3, 1, 1},      {262, 3, 1, 1},       {273, 4, 1, 8},
            {277, 3, 1, 1},      {278, 4, 1, kHeight}, {279, 4, 1, kWidth * kHeight * 4},
            {339, 3, 1, 3}};
  }
  static std::string tiff(const std::vector<Tag>& tags) {
    std::string bytes("II\x2a\0", 4);
    auto put = [&](auto value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(std::uint32_t(8 + kWidth * kHeight * 4));
    for (int i = 0; i < kWidth * kHeight; ++i) put(float(i));
    put(std::uint16_t(tags.size()));
    for (const Tag& t : tags) {
      put(t.number);
      put(t.type);
      put(t.count);
      put(t.value);
    }
    put(std::uint32_t(0));
    return bytes;
  }
  Status read(const std::string& bytes, Raster* raster) {
    const std::string path = folder_ + "/in.tif";
    std::ofstream(path, std::ios::binary) << bytes;
    RasterOptions options;
    options.cell_size = 10;
    return read_raster(path, options, raster);
  }
  // With one tag that is not true.
  Status with(std::uint16_t number, std::uint32_t value, Raster* raster) {
    auto list = tags();
    for (Tag& t : list) {
      if (t.number == number) t.value = value;
    }
    return read(tiff(list), raster);
  }

  std::string folder_;
};

TEST_F(LyingTiff, TheTrueOneIsRead) {
  Raster raster;
  const Status s = read(tiff(tags()), &raster);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(raster.width, kWidth);
  EXPECT_EQ(raster.height, kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) EXPECT_EQ(raster.heights[i], float(i));
}

TEST_F(LyingTiff, LiesAreRefused) {
  Raster raster;
  raster.width = -1;
  const std::pair<std::uint16_t, std::uint32_t> lies[] = {
      {256, 0},      {257, 0},          {256, 0x7fffffff}, {257, 0x7fffffff}, {256, 300000},
      {257, 300000}, {258, 0},          {258, 65535},      {259, 5},          {259, 8},
      {259, 60000},  {273, 0x7ffffff0}, {277, 60000}};
  for (const auto& [number, value] : lies) {
    const Status s = with(number, value, &raster);
    EXPECT_FALSE(s.ok()) << number << " " << value;
    EXPECT_NE(s.message().find("in.tif"), std::string::npos) << s.message();
    EXPECT_EQ(s.message().find('\n'), std::string::npos) << s.message();
  }
  EXPECT_EQ(raster.width, -1);
}

// Whatever one word of the header says: a message, or a raster that is whole.
TEST_F(LyingTiff, NoWordIsTrusted) {
  const std::string good = tiff(tags());
  const std::size_t directory = 8 + kWidth * kHeight * 4;
  int read_anyway = 0;
  for (std::size_t at = 0; at + 2 <= good.size(); at += at == 8 ? directory - 8 : 1) {
    for (const std::uint16_t word : {0, 1, 255, 0x7fff, 0x8000, 0xffff}) {
      std::string bytes = good;
      bytes.replace(at, 2, reinterpret_cast<const char*>(&word), 2);
      Raster raster;
      const Status s = read(bytes, &raster);
      if (!s.ok()) {
        EXPECT_NE(s.message(), "");
        continue;
      }
      ++read_anyway;
      EXPECT_EQ(raster.heights.size(), std::size_t(raster.width) * raster.height);
      EXPECT_LE(raster.heights.size(), std::size_t(1) << 26);
    }
  }
  EXPECT_GT(read_anyway, 0);
}

}  // namespace
}  // namespace obscura::tools
