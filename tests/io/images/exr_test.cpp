#include "io/images/exr.h"

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>

#include <cmath>
#include <cstring>

#include "io/images/files.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

using Imath::Box2i;

// Ways in which others write a channel "Z" of floats over a 5 x 3 window that begins at (2, -1).
const Box2i kData({2, -1}, {6, 1}), kDisplay({0, 0}, {7, 3});
constexpr int kWidth = 5, kHeight = 3;

Imf::Slice slice_of(const Image& image) {
  return Imf::Slice::Make(Imf::FLOAT, image.channels[0].values.data(), kData, 4, 4 * kWidth);
}

void write_tiled(const std::string& path, const Image& image) {
  Imf::Header header(kDisplay, kData);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(2, 2, Imf::ONE_LEVEL));
  Imf::TiledOutputFile file(path.c_str(), header);
  Imf::FrameBuffer frame;
  frame.insert("Z", slice_of(image));
  file.setFrameBuffer(frame);
  file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

void write_compressed(const std::string& path, const Image& image, Imf::Compression compression) {
  Imf::Header header(kDisplay, kData);
  header.compression() = compression;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  Imf::OutputFile file(path.c_str(), header);
  Imf::FrameBuffer frame;
  frame.insert("Z", slice_of(image));
  file.setFrameBuffer(frame);
  file.writePixels(kHeight);
}

void write_two_parts(const std::string& path, const Image& image) {
  Imf::Header headers[2];
  for (int i = 0; i < 2; ++i) {
    headers[i] = Imf::Header(kDisplay, kData);
    headers[i].setName(i == 0 ? "first" : "second");
    headers[i].setType(Imf::SCANLINEIMAGE);
    headers[i].channels().insert(i == 0 ? "Z" : "other", Imf::Channel(Imf::FLOAT));
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers, 2);
  for (int i = 0; i < 2; ++i) {
    Imf::OutputPart part(file, i);
    Imf::FrameBuffer frame;
    frame.insert(i == 0 ? "Z" : "other", slice_of(image));
    part.setFrameBuffer(frame);
    part.writePixels(kHeight);
  }
}

TEST_F(FilesTest, ExrOfOthersIsRead) {
  const Image image = ramp(kWidth, kHeight, {"Z"});
  write_tiled(path("tiled.exr"), image);
  write_two_parts(path("parts.exr"), image);
  const auto compressions = {Imf::NO_COMPRESSION,  Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                             Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::B44A_COMPRESSION,
                             Imf::DWAA_COMPRESSION};
  std::vector<std::string> names{"tiled.exr", "parts.exr"};
  for (Imf::Compression c : compressions) {
    names.push_back(std::to_string(c) + ".exr");
    write_compressed(path(names.back()), image, c);
  }
  for (const std::string& name : names) {
    ExrHeader header;
    Image again;
    const Status s = read_exr(path(name), {}, &header, &again);
    ASSERT_TRUE(s.ok()) << s.message();
    EXPECT_EQ(header.data_window, (PixelWindow{2, -1, 6, 1}));
    EXPECT_EQ(header.display_window, (PixelWindow{0, 0, 7, 3}));
    ASSERT_EQ(again.channels.size(), 1u);
    EXPECT_EQ(again.channels[0].values, image.channels[0].values) << name;
  }
}

// An image of one value compresses far; it must not be taken for a lie about its size.
TEST_F(FilesTest, FlatExrIsNotTakenForTruncated) {
  constexpr int kSide = 1024;
  const std::vector<float> zeros(kSide * kSide, 0.0f);
  for (Imf::Compression c :
       {Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
        Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    for (Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
      Imf::Header header(kSide, kSide);
      header.compression() = c;
      for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(type));
      {
        Imf::OutputFile file(path("flat.exr").c_str(), header);
        Imf::FrameBuffer frame;
        for (const char* name : {"R", "G", "B"}) {
          frame.insert(name, Imf::Slice::Make(type, zeros.data(), header.dataWindow()));
        }
        file.setFrameBuffer(frame);
        file.writePixels(kSide);
      }
      ExrHeader read;
      Image image;
      const Status s = read_exr(path("flat.exr"), {"G"}, &read, &image);
      EXPECT_TRUE(s.ok()) << "compression " << c << ": " << s.message();
    }
  }
}

TEST_F(FilesTest, ExrKeepsWhatIsNotFinite) {
  Image image(4, 1);
  image.add("Z") = {NAN, INFINITY, -INFINITY, 1e30f};
  for (bool half : {false, true}) {
    ASSERT_TRUE(write_image(path("a.exr"), image, {.half = half}).ok());
    Image again;
    ASSERT_TRUE(read_image(path("a.exr"), &again).ok());
    const std::vector<float>& v = again.channels[0].values;
    EXPECT_TRUE(std::isnan(v[0]));
    EXPECT_EQ(v[1], INFINITY);
    EXPECT_EQ(v[2], -INFINITY);
    EXPECT_EQ(v[3], half ? INFINITY : 1e30f);
  }
}

TEST_F(FilesTest, SmallAndOddExrSizes) {
  for (auto [w, h] : {std::pair{1, 1}, {1, 37}, {37, 1}, {17, 33}}) {
    const Image image = ramp(w, h, {"Y"});
    ASSERT_TRUE(write_image(path("a.exr"), image).ok());
    Image again;
    ASSERT_TRUE(read_image(path("a.exr"), &again).ok());
    EXPECT_EQ(again.width, w);
    EXPECT_EQ(again.channels[0].values, image.channels[0].values);
  }
  EXPECT_FALSE(write_image(path("none.exr"), Image(0, 0)).ok());
  EXPECT_EQ(files_in_folder(), 1);
}

TEST_F(FilesTest, DeepAndSubsampledExrAreRefused) {
  {
    Imf::Header header(4, 4);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    Imf::DeepScanLineOutputFile file(path("deep.exr").c_str(), header);
    std::vector<unsigned> counts(16, 0);
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 16));
    std::vector<float*> samples(16, nullptr);
    frame.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()),
                                     sizeof(float*), sizeof(float*) * 4, sizeof(float)));
    file.setFrameBuffer(frame);
    file.writePixels(4);
  }
  ExrHeader header;
  Image image;
  EXPECT_NE(read_exr(path("deep.exr"), {}, &header, &image).message().find("deep"),
            std::string::npos);
  {
    Imf::Header chroma(4, 4);
    chroma.channels().insert("BY", Imf::Channel(Imf::FLOAT, 2, 2));
    chroma.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    const std::vector<float> values(16, 0.5f);
    Imf::OutputFile file(path("chroma.exr").c_str(), chroma);
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), chroma.dataWindow()));
    frame.insert("BY",
                 Imf::Slice::Make(Imf::FLOAT, values.data(), chroma.dataWindow(), 0, 0, 2, 2));
    file.setFrameBuffer(frame);
    file.writePixels(4);
  }
  EXPECT_FALSE(read_exr(path("chroma.exr"), {"BY"}, &header, &image).ok());
  ASSERT_TRUE(read_exr(path("chroma.exr"), {}, &header, &image).ok());
  EXPECT_EQ(image.channels.size(), 1u);
  const Status s =
      write_image(path("v.exr"), ramp(4, 4, {"v"}), {.keep_channels_of = path("chroma.exr")});
  EXPECT_NE(s.message().find("BY is subsampled"), std::string::npos) << s.message();
}

// Every shorter file is refused; a file with flipped bytes is refused or read, and no more.
TEST_F(FilesTest, DamagedExrNeverHarms) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(24, 24, {"N.X", "Z"})).ok());
  write_tiled(path("b.exr"), ramp(kWidth, kHeight, {"Z"}));
  write_two_parts(path("c.exr"), ramp(kWidth, kHeight, {"Z"}));
  for (const char* name : {"a.exr", "b.exr", "c.exr"}) {
    const std::string whole = content(name);
    Image image;
    ExrHeader header;
    // The second part of c.exr is not read.
    const std::size_t needed = name[0] == 'c' ? whole.size() / 2 : whole.size();
    for (std::size_t keep = 0; keep < needed; keep += keep < 400 ? 7 : 61) {
      write("cut.exr", whole.substr(0, keep));
      EXPECT_EQ(read_exr(path("cut.exr"), {}, &header, &image).code(), StatusCode::kInvalidInput)
          << name << " cut to " << keep;
    }
    for (std::size_t at = 0; at < whole.size(); at += at < 500 ? 3 : 41) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ (at % 2 ? 0xff : 0x80));
      write("damaged.exr", damaged);
      const Status s = read_exr(path("damaged.exr"), {}, &header, &image);
      EXPECT_TRUE(s.ok() || s.code() == StatusCode::kInvalidInput) << s.message();
    }
  }
}

// The windows of a header, where they stand in the bytes of a file.
void set_window(std::string* bytes, const std::string& name, const PixelWindow& w) {
  const std::size_t at = bytes->find(name + '\0' + "box2i") + name.size() + 1 + 6 + 4;
  const std::int32_t values[] = {w.min_x, w.min_y, w.max_x, w.max_y};
  std::memcpy(bytes->data() + at, values, sizeof(values));
}

TEST_F(FilesTest, WindowsBeyondReasonAreRefused) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(8, 8, {"Z"})).ok());
  const std::string whole = content("a.exr");
  constexpr int kBig = 2000000000;
  for (const char* name : {"dataWindow", "displayWindow"}) {
    for (const PixelWindow& w : {PixelWindow{0, 0, 70000, 7},
                                 {0, 0, 7, kBig},
                                 {-kBig, -kBig, kBig, kBig},
                                 {5, 5, 4, 4},
                                 {kBig, kBig, kBig + 7, kBig + 7},
                                 {-kBig, -kBig, 7 - kBig, 7 - kBig}}) {
      std::string bytes = whole;
      set_window(&bytes, name, w);
      write("b.exr", bytes);
      std::vector<ExrHeader> parts;
      EXPECT_EQ(read_exr_headers(path("b.exr"), &parts).code(), StatusCode::kInvalidInput);
    }
  }
}

// OpenEXR would allocate what the damaged numbers say.
TEST_F(FilesTest, AttributesThatClaimTooMuchAreRefused) {
  ASSERT_TRUE(write_image(path("a.exr"), ramp(8, 8, {"Z"})).ok());
  const std::string whole = content("a.exr");
  struct Damage {
    std::string before;
    std::size_t offset;
    char value;
  };
  for (const Damage& d : {Damage{std::string("channels\0chlist\0", 16), 3, 0x7f},  // 2 GB
                          {std::string("channels\0chlist\0", 16), 4 + 1, 'Z'},  // an endless name
                          {std::string("dataWindow\0box2i\0", 17), 0, 12},
                          {std::string("compression\0compression\0", 24), 0, 2}}) {
    std::string bytes = whole;
    bytes[bytes.find(d.before) + d.before.size() + d.offset] = d.value;
    write("b.exr", bytes);
    std::vector<ExrHeader> parts;
    const Status s = read_exr_headers(path("b.exr"), &parts);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find("damaged in its header"), std::string::npos) << s.message();
  }
}

// A source with a uint identifier, a half colour and depth; its data window is the display window
// moved by (1, 1), so that a row and a column are missing.
void write_source(const std::string& path) {
  Imf::Header header(Box2i({0, 0}, {3, 3}), Box2i({1, 1}, {4, 4}));
  header.insert("owner", Imf::StringAttribute("a studio"));
  std::vector<unsigned> id(16);
  std::vector<half> red(16);
  std::vector<float> z(16);
  for (int i = 0; i < 16; ++i) {
    id[i] = 4000000001u + i;  // no float holds it
    red[i] = static_cast<float>(i);
    z[i] = 1.0f + i;
  }
  const Box2i& data = header.dataWindow();
  header.channels().insert("id", Imf::Channel(Imf::UINT));
  header.channels().insert("R", Imf::Channel(Imf::HALF));
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  Imf::FrameBuffer frame;
  frame.insert("id", Imf::Slice::Make(Imf::UINT, id.data(), data));
  frame.insert("R", Imf::Slice::Make(Imf::HALF, red.data(), data));
  frame.insert("Z", Imf::Slice::Make(Imf::FLOAT, z.data(), data));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(4);
}

TEST_F(FilesTest, KeptChannelsHaveTheirTypesAndValues) {
  write_source(path("in.exr"));
  ASSERT_TRUE(write_image(path("out.exr"), ramp(4, 4, {"visibility", "R"}),
                          {.half = true, .keep_channels_of = path("in.exr")})
                  .ok());
  ExrHeader header;
  Image image;
  ASSERT_TRUE(read_exr(path("out.exr"), {}, &header, &image).ok());
  EXPECT_EQ(header.data_window, (PixelWindow{0, 0, 3, 3}));
  EXPECT_EQ(header.find("id")->type, "uint");
  EXPECT_EQ(header.find("Z")->type, "float");
  EXPECT_EQ(header.find("visibility")->type, "half");
  EXPECT_NE(std::find(header.attributes.begin(), header.attributes.end(), "owner"),
            header.attributes.end());
  // The result's own R comes before the source's.
  EXPECT_EQ(image.find("R")->values[0], 2.125f);
  EXPECT_EQ(image.find("Z")->values[0], INFINITY);  // no pixel there
  EXPECT_EQ(image.find("Z")->values[5], 1);
  EXPECT_EQ(image.find("id")->values[0], 0);
  EXPECT_EQ(image.find("id")->values[5], 4000000001.0f);

  // Kept a second time, the identifiers are the same to the bit: the chunks are.
  ASSERT_TRUE(write_image(path("again.exr"), ramp(4, 4, {"visibility", "R"}),
                          {.half = true, .keep_channels_of = path("out.exr")})
                  .ok());
  EXPECT_EQ(content("again.exr"), content("out.exr"));
}

TEST_F(FilesTest, KeptChannelsFollowAGuardBandInsideTheDisplayWindow) {
  ASSERT_TRUE(write_image(path("in.exr"), ramp(6, 5, {"Z"})).ok());
  const WriteOptions options{.keep_channels_of = path("in.exr"),
                             .kept_guard_band = GuardBand::symmetric(2, 1)};
  ASSERT_TRUE(write_image(path("out.exr"), ramp(2, 3, {"v"}), options).ok());
  ExrHeader header;
  Image image;
  ASSERT_TRUE(read_exr(path("out.exr"), {}, &header, &image).ok());
  EXPECT_EQ(header.display_window, (PixelWindow{0, 0, 5, 4}));
  EXPECT_EQ(header.data_window, (PixelWindow{2, 1, 3, 3}));
  EXPECT_EQ(image.find("Z")->values[0], 0.125f * (6 + 2 + 1));
  const Status s = write_image(path("bad.exr"), ramp(6, 3, {"v"}), options);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find("2x3"), std::string::npos) << s.message();
}

}  // namespace
}  // namespace obscura::tools
