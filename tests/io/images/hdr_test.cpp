#include "io/images/hdr.h"

#include <gtest/gtest.h>

namespace obscura::tools {
namespace {

const std::string kHeader = "#?RADIANCE\nSOFTWARE=none\nFORMAT=32-bit_rle_rgbe\n\n";

std::string bytes(std::initializer_list<int> values) {
  std::string out;
  for (int v : values) out.push_back(static_cast<char>(v));
  return out;
}

void expect_refused(const std::string& file, const std::string& part) {
  Image image;
  const Status s = decode_hdr(file, "x.hdr", &image);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find(part), std::string::npos) << s.message();
}

// One row of 8 pixels: red is a run of 8, the others are stored or cut into runs.
const std::string kCoded = kHeader + "-Y 1 +X 8\n" +
                           bytes({2,   2,   0, 8,   136, 128,           // red: eight times 128
                                  8,   1,   2, 3,   4,   5,   6, 7, 8,  // green
                                  130, 9,   6, 0,   0,   0,   0, 0, 0,  // blue: 9, 9 and six zeros
                                  131, 129, 5, 130, 0,   1,   2, 3});   // exponents

TEST(Hdr, RunsPerComponent) {
  Image image;
  const Status s = decode_hdr(kCoded, "x", &image);
  ASSERT_TRUE(s.ok()) << s.message();
  ASSERT_EQ(image.width, 8);
  ASSERT_EQ(image.height, 1);
  EXPECT_EQ(image.view(0)(2, 0), 1);  // 128 2^(129 - 136)
  EXPECT_EQ(image.view(0)(3, 0), 2);  // exponent 130
  EXPECT_EQ(image.view(0)(4, 0), 0);  // exponent 0
  EXPECT_EQ(image.view(1)(1, 0), 2 / 128.0f);
  EXPECT_EQ(image.view(2)(1, 0), 9 / 128.0f);
  EXPECT_EQ(image.view(2)(2, 0), 0);
}

// Radiances are the file's values divided by all EXPOSURE and COLORCORR lines.
TEST(Hdr, ExposuresAreTakenOut) {
  Image image;
  std::string file = kCoded;
  file.insert(file.find("FORMAT="), "EXPOSURE=2\nEXPOSURE= 4.0\nCOLORCORR= 0.5 1 2\n");
  const Status s = decode_hdr(file, "x", &image);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(image.view(0)(2, 0), 1 / 4.0f);
  EXPECT_EQ(image.view(1)(1, 0), 2 / 128.0f / 8);
  EXPECT_EQ(image.view(2)(1, 0), 9 / 128.0f / 16);
  for (const char* line : {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=", "EXPOSURE=inf",
                           "COLORCORR=1 1", "EXPOSURE=1e-40"}) {
    expect_refused(std::string("#?RADIANCE\n") + line + "\n\n-Y 1 +X 1\n" + bytes({1, 1, 1, 128}),
                   line);
  }
}

// Two rows of a pixel and runs of it: 8 + 4 bytes that stand for 65535 pixels each.
TEST(Hdr, AFewBytesThatUnfoldToAnImageThatFillsTheMemoryAreRefused) {
  std::string file = kHeader + "-Y 2000 +X 65535\n";
  for (int y = 0; y < 2000; ++y) file += bytes({9, 9, 9, 128, 1, 1, 1, 254, 1, 1, 1, 255});
  expect_refused(file, "times as large as its file");
}

TEST(Hdr, EveryShorterFileIsRefused) {
  for (std::size_t keep = 0; keep < kCoded.size(); ++keep) {
    Image image;
    EXPECT_FALSE(decode_hdr(kCoded.substr(0, keep), "x", &image).ok()) << keep;
  }
}

TEST(Hdr, FlatPixelsAndOldRuns) {
  // Three rows of 2; then one of 300, whose run needs two digits: 43 + 256.
  Image image;
  const std::string flat =
      kHeader + "-Y 3 +X 2\n" + bytes({128, 0, 0, 129, 0,  128, 0, 129, 64, 0, 0,  129,
                                       1,   1, 1, 1,   32, 0,   0, 129, 0,  0, 16, 129});
  ASSERT_TRUE(decode_hdr(flat, "x", &image).ok());
  EXPECT_EQ(image.view(0)(0, 0), 1);
  EXPECT_EQ(image.view(1)(1, 0), 1);
  EXPECT_EQ(image.view(0)(1, 1), 0.5f);
  EXPECT_EQ(image.view(2)(1, 2), 0.125f);
  const std::string run =
      kHeader + "-Y 1 +X 300\n" + bytes({128, 0, 0, 129, 1, 1, 1, 43, 1, 1, 1, 1});
  ASSERT_TRUE(decode_hdr(run, "x", &image).ok());
  for (float v : image.channels[0].values) EXPECT_EQ(v, 1);
}

TEST(Hdr, DamageIsNamed) {
  expect_refused("", "begin with #?");
  expect_refused("P6\n1 1\n255\nabc", "begin with #?");
  expect_refused("#?RADIANCE\n", "truncated");
  expect_refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "32-bit_rle_rgbe");
  expect_refused(kHeader + "+X 8 -Y 1\n", "-Y HEIGHT +X WIDTH");
  expect_refused(kHeader + "-Y 0 +X 8\n", "8x0");
  expect_refused(kHeader + "-Y 65536 +X 8\n", "[1, 65535]");
  expect_refused(kHeader + "-Y 99999999999 +X 8\n", "-Y HEIGHT +X WIDTH");
  expect_refused(kHeader + "-Y 60000 +X 60000\nabcd", "truncated");
  // A run that leaves the row, a run of nothing, a repetition of nothing.
  expect_refused(kHeader + "-Y 1 +X 8\n" + bytes({2, 2, 0, 8, 137, 1}), "row 0");
  expect_refused(kHeader + "-Y 1 +X 8\n" + bytes({2, 2, 0, 8, 0, 1, 1, 1}), "row 0");
  expect_refused(kHeader + "-Y 1 +X 2\n" + bytes({1, 1, 1, 2}), "row 0");
  expect_refused(kHeader + "-Y 1 +X 2\n" + bytes({9, 9, 9, 9, 1, 1, 1, 2}), "row 0");
}

}  // namespace
}  // namespace obscura::tools
