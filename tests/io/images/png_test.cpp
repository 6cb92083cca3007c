#include "io/images/png.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

std::string encoded(const Image& image, int bits) {
  std::string bytes;
  const Status s = encode_png(image, bits, &bytes);
  EXPECT_TRUE(s.ok()) << s.message();
  return bytes;
}

std::string big_endian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(sum));
}

// A file by hand: `rows` are the filter bytes and samples.
std::string png_file(std::uint32_t width, std::uint32_t height, char bits, char color,
                     const std::string& before, const std::string& rows) {
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()));
  packed.resize(size);
  const std::string header =
      big_endian(width) + big_endian(height) + bits + color + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + before + chunk("IDAT", packed) +
         chunk("IEND", "");
}

TEST(Png, ReadsBackWhatWasWritten) {
  for (int bits : {8, 16}) {
    const float full = bits == 8 ? 255 : 65535;
    for (int channels : {1, 3}) {
      Image image(5, 3);
      for (int c = 0; c < channels; ++c) {
        float v = static_cast<float>(c);
        for (float& x : image.add(channels == 1 ? "Y" : c == 0 ? "R" : c == 1 ? "G" : "B")) {
          x = (v += 7) / full;
        }
      }
      Image again;
      bool sixteen = false;
      ASSERT_TRUE(decode_png(encoded(image, bits), "x", &again, &sixteen).ok());
      EXPECT_EQ(sixteen, bits == 16);
      ASSERT_EQ(again.channels.size(), static_cast<std::size_t>(channels));
      for (int c = 0; c < channels; ++c) {
        EXPECT_EQ(again.channels[c].name, image.channels[c].name);
        EXPECT_EQ(again.channels[c].values, image.channels[c].values);
      }
    }
  }
}

TEST(Png, WhatIsNoVisibilityHasAValue) {
  Image image(6, 1);
  image.add("Y") = {NAN, INFINITY, -INFINITY, -3, 2, 0.5f};
  for (int bits : {8, 16}) {
    Image again;
    ASSERT_TRUE(decode_png(encoded(image, bits), "x", &again).ok());
    const std::vector<float>& v = again.channels[0].values;
    EXPECT_EQ(std::vector<float>(v.begin(), v.begin() + 5), (std::vector<float>{0, 1, 0, 0, 1}));
    EXPECT_NEAR(v[5], 0.5, bits == 8 ? 0.6 / 255 : 0.6 / 65535);
  }
}

TEST(Png, SmallDepthsAndPalettesBecomeGreyOrColour) {
  Image image;
  ASSERT_TRUE(decode_png(png_file(4, 1, 1, 0, "", {'\0', '\x50'}), "x", &image).ok());
  EXPECT_EQ(image.channels[0].values, (std::vector<float>{0, 1, 0, 1}));
  const std::string palette = chunk("PLTE", {'\0', '\0', '\0', '\xff', '\0', '\0'});
  ASSERT_TRUE(decode_png(png_file(2, 1, 8, 3, palette, {'\0', '\1', '\0'}), "x", &image).ok());
  ASSERT_EQ(image.channels.size(), 3u);
  EXPECT_EQ(image.channels[0].values, (std::vector<float>{1, 0}));
  // Grey with alpha: the alpha goes.
  ASSERT_TRUE(decode_png(png_file(1, 1, 8, 4, "", {'\0', '\xff', '\7'}), "x", &image).ok());
  ASSERT_EQ(image.channels.size(), 1u);
  EXPECT_EQ(image.channels[0].values[0], 1);
}

TEST(Png, EveryShorterFileAndEveryFlippedByteIsRefused) {
  testing::internal::CaptureStderr();
  const std::string whole = encoded(ramp(9, 7, {"Y"}), 16);
  for (std::size_t keep = 0; keep + 12 < whole.size(); ++keep) {  // IEND holds nothing
    Image image;
    EXPECT_EQ(decode_png(whole.substr(0, keep), "x", &image).code(), StatusCode::kInvalidInput)
        << keep;
  }
  for (std::size_t at = 0; at + 12 < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    Image image;
    EXPECT_EQ(decode_png(damaged, "x", &image).code(), StatusCode::kInvalidInput) << at;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Png, AHeaderThatClaimsTooMuchIsRefused) {
  for (auto [w, h] :
       {std::pair{60000u, 60000u}, {65536u, 1u}, {0u, 4u}, {4u, 0u}, {4294967295u, 2u}}) {
    Image image;
    const Status s = decode_png(png_file(w, h, 16, 0, "", "abc"), "x.png", &image);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find("x.png"), std::string::npos);
  }
}

// A white image of 17,000 x 17,000 pixels in about 40 kB.
TEST(Png, AFewBytesThatUnfoldToAnImageThatFillsTheMemoryAreRefused) {
  std::string rows;
  for (int y = 0; y < 17000; ++y) rows += std::string(1 + 17000 / 8, '\0');
  Image image;
  const Status s = decode_png(png_file(17000, 17000, 1, 0, "", rows), "x.png", &image);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find("x.png: 17000x17000 pixels from"), std::string::npos) << s.message();
}

TEST(Png, RefusesWhatItCannotHold) {
  std::string bytes;
  EXPECT_EQ(encode_png(ramp(2, 2, {"a", "b"}), 8, &bytes).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(encode_png(ramp(2, 2, {"a"}), 12, &bytes).code(), StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace obscura::tools
