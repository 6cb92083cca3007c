#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputPart.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/images/exr.h"

namespace obscura::tools {
namespace {

constexpr int kWidth = 20, kHeight = 12;  // of the display window
// The data window reaches beyond it on the left and leaves out rows below.
const Imath::Box2i kDisplay({0, 0}, {kWidth - 1, kHeight - 1}), kData({-4, 0}, {19, 8});
constexpr int kPixels = 24 * 9;

// Numbers whose bits a float that passes through arithmetic would not keep, as cryptomatte's.
std::vector<std::uint32_t> ids(std::uint32_t seed) {
  std::vector<std::uint32_t> list(kPixels);
  for (std::uint32_t& v : list) v = (seed = seed * 1664525u + 1013904223u) & 0xff7fffffu;
  return list;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class ExrAdd : public testing::Test {
 protected:
  ExrAdd() { std::filesystem::create_directory(folder_); }
  ~ExrAdd() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return folder_ + "/" + name; }

  static Imf::Slice slice(Imf::PixelType type, void* pixels, int bytes) {
    return {type, static_cast<char*>(pixels) + (4 - 0 * 24) * bytes, std::size_t(bytes),
            std::size_t(24 * bytes)};
  }

  // Beauty with ids and text about them, a tiled part, a deep part.
  void write_file(const std::string& file, int parts,
                  Imf::Compression compression = Imf::PIZ_COMPRESSION) {
    std::vector<Imf::Header> headers;
    for (int p = 0; p < parts; ++p) {
      Imf::Header h(kDisplay, kData);
      h.compression() = p == 0 ? compression : Imf::ZIPS_COMPRESSION;
      h.setType(p == 0 ? Imf::SCANLINEIMAGE : p == 1 ? Imf::TILEDIMAGE : Imf::DEEPSCANLINE);
      if (parts > 1) h.setName(p == 0 ? "rgba" : p == 1 ? "id" : "deep");
      if (p == 0) {
        h.channels().insert("R", Imf::Channel(Imf::HALF));
        h.channels().insert("crypto00.R", Imf::Channel(Imf::FLOAT));
        h.insert("cryptomatte/bda530a/manifest", Imf::StringAttribute("{\"chair\":\"0a1b2c3d\"}"));
      } else {
        h.channels().insert("Z", Imf::Channel(p == 1 ? Imf::UINT : Imf::FLOAT));
      }
      if (p == 1) h.setTileDescription({8, 8, Imf::ONE_LEVEL});
      headers.push_back(h);
    }
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), parts);
    std::vector<half> red(kPixels);
    for (int k = 0; k < kPixels; ++k) red[std::size_t(k)].setBits(std::uint16_t(k * 77 & 0x7bff));
    std::vector<std::uint32_t> crypto = ids(1), id = ids(2);
    Imf::FrameBuffer frame;
    frame.insert("R", slice(Imf::HALF, red.data(), 2));
    frame.insert("crypto00.R", slice(Imf::FLOAT, crypto.data(), 4));
    Imf::OutputPart first(out, 0);
    first.setFrameBuffer(frame);
    first.writePixels(9);
    if (parts > 1) {
      Imf::FrameBuffer second_frame;
      second_frame.insert("Z", slice(Imf::UINT, id.data(), 4));
      Imf::TiledOutputPart second(out, 1);
      second.setFrameBuffer(second_frame);
      second.writeTiles(0, second.numXTiles() - 1, 0, second.numYTiles() - 1);
    }
    if (parts > 2) {
      std::vector<unsigned> counts(kPixels, 2);
      std::vector<std::vector<float>> samples(kPixels, {1.5f, 2.5f});
      std::vector<float*> pointers;
      for (auto& s : samples) pointers.push_back(s.data());
      Imf::DeepFrameBuffer deep;
      deep.insertSampleCountSlice(slice(Imf::UINT, counts.data(), 4));
      deep.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data() + 4),
                                      sizeof(float*), 24 * sizeof(float*), sizeof(float)));
      Imf::DeepScanLineOutputPart third(out, 2);
      third.setFrameBuffer(deep);
      third.writePixels(9);
    }
  }

  Image result() {
    Image image(kWidth, kHeight);
    std::vector<float>& v = image.add("visibility");
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = float(k) / 256;
    return image;
  }

  // Bits of the first part's old channels, whatever else is there.
  void expect_kept(const std::string& file) {
    Imf::MultiPartInputFile in(file.c_str());
    EXPECT_EQ(in.header(0).displayWindow(), kDisplay);
    EXPECT_EQ(in.header(0).dataWindow(), kData);
    const auto* text =
        in.header(0).findTypedAttribute<Imf::StringAttribute>("cryptomatte/bda530a/manifest");
    ASSERT_TRUE(text);
    EXPECT_EQ(text->value(), "{\"chair\":\"0a1b2c3d\"}");
    EXPECT_EQ(in.header(0).channels()["R"].type, Imf::HALF);
    std::vector<std::uint16_t> red(kPixels);
    std::vector<std::uint32_t> crypto(kPixels);
    Imf::FrameBuffer frame;
    frame.insert("R", slice(Imf::HALF, red.data(), 2));
    frame.insert("crypto00.R", slice(Imf::FLOAT, crypto.data(), 4));
    Imf::InputPart part(in, 0);
    part.setFrameBuffer(frame);
    part.readPixels(0, 8);
    EXPECT_EQ(crypto, ids(1));
    for (int k = 0; k < kPixels; ++k) EXPECT_EQ(red[std::size_t(k)], k * 77 & 0x7bff);
  }

  const std::string folder_ =
      std::filesystem::temp_directory_path().string() + "/obscura-add-" + std::to_string(getpid());
};

TEST_F(ExrAdd, ChannelsJoinAndAllElseKeepsItsBits) {
  write_file(path("a.exr"), 3);
  const Image image = result();
  ExrAddOptions options;
  options.layer = "ao";
  Status s = add_to_exr(path("b.exr"), path("a.exr"), image, options);
  ASSERT_TRUE(s.ok()) << s.message();
  expect_kept(path("b.exr"));
  ExrHeader header;
  Image got;
  ASSERT_TRUE(read_exr(path("b.exr"), {"ao.visibility"}, &header, &got).ok());
  for (int y = 0; y <= 8; ++y) {
    for (int x = -4; x < kWidth; ++x) {
      const float expected = x < 0 ? 1 : float(y * kWidth + x) / 256;
      EXPECT_EQ(got.view(0)(x + 4, y), expected) << x << " " << y;
    }
  }
  // The other parts, byte for byte: their compressed pixels stand in both files.
  std::vector<ExrHeader> parts;
  ASSERT_TRUE(read_exr_headers(path("b.exr"), &parts).ok());
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[1].part_name, "id");
  EXPECT_TRUE(parts[2].deep);
  Image a, b;
  ASSERT_TRUE(read_exr(path("a.exr"), {}, &header, &a, 1).ok());
  ASSERT_TRUE(read_exr(path("b.exr"), {}, &header, &b, 1).ok());
  EXPECT_EQ(a.channels[0].values, b.channels[0].values);
  std::vector<DeepLayer> layers;
  ASSERT_TRUE(read_exr_deep(path("b.exr"), 2, 4, &layers).ok());
  EXPECT_EQ(layers[1].front[0], 2.5f);
}

TEST_F(ExrAdd, LossyCompressionGivesWayAndTheChosenOneIsTaken) {
  write_file(path("a.exr"), 1, Imf::PXR24_COMPRESSION);
  // PXR24 rounds floats: what it has left is to be kept from here on.
  ExrHeader header;
  Image before, after;
  ASSERT_TRUE(read_exr(path("a.exr"), {}, &header, &before).ok());
  ASSERT_TRUE(add_to_exr(path("b.exr"), path("a.exr"), result(), {}).ok());
  EXPECT_EQ(Imf::MultiPartInputFile(path("b.exr").c_str()).header(0).compression(),
            Imf::ZIP_COMPRESSION);
  ASSERT_TRUE(read_exr(path("b.exr"), {"R", "crypto00.R"}, &header, &after).ok());
  for (const char* name : {"R", "crypto00.R"}) {
    EXPECT_EQ(before.find(name)->values, after.find(name)->values);
  }
  ExrAddOptions options;
  options.compression = "zips";
  options.half = true;
  ASSERT_TRUE(add_to_exr(path("c.exr"), path("a.exr"), result(), options).ok());
  Imf::MultiPartInputFile c(path("c.exr").c_str());
  EXPECT_EQ(c.header(0).compression(), Imf::ZIPS_COMPRESSION);
  EXPECT_EQ(c.header(0).channels()["visibility"].type, Imf::HALF);
}

TEST_F(ExrAdd, PartsByNameByNumberAndNew) {
  write_file(path("a.exr"), 3);
  ExrAddOptions options;
  options.part = "id";
  Status s = add_to_exr(path("b.exr"), path("a.exr"), result(), options);
  ASSERT_TRUE(s.ok()) << s.message();
  std::vector<ExrHeader> parts;
  ASSERT_TRUE(read_exr_headers(path("b.exr"), &parts).ok());
  EXPECT_TRUE(parts[1].find("visibility"));
  EXPECT_FALSE(parts[0].find("visibility"));
  expect_kept(path("b.exr"));
  options.part = "ao";
  s = add_to_exr(path("c.exr"), path("a.exr"), result(), options);
  ASSERT_TRUE(s.ok()) << s.message();
  ASSERT_TRUE(read_exr_headers(path("c.exr"), &parts).ok());
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[3].part_name, "ao");
  ExrHeader header;
  Image got;
  ASSERT_TRUE(read_exr(path("c.exr"), {}, &header, &got, 3).ok());
  EXPECT_EQ(got.channels[0].values, result().channels[0].values);
  expect_kept(path("c.exr"));
  // A file of one part without a name gets a second one too.
  write_file(path("one.exr"), 1);
  s = add_to_exr(path("d.exr"), path("one.exr"), result(), options);
  ASSERT_TRUE(s.ok()) << s.message();
  expect_kept(path("d.exr"));
}

TEST_F(ExrAdd, WhatCannotBeAddedIsNamed) {
  write_file(path("a.exr"), 3);
  const std::string before = bytes_of(path("a.exr"));
  auto message = [&](const Image& image, const ExrAddOptions& options) {
    const Status s = add_to_exr(path("b.exr"), path("a.exr"), image, options);
    EXPECT_FALSE(s.ok());
    return s.message();
  };
  auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), text.npos) << text;
  };
  has(message(result(), {.part = "2"}), "is deep, which takes no channels");
  has(message(result(), {.part = "7"}), "there is no part 7; it has 3");
  has(message(Image(3, 3), {}), "what it shows is 20x12, the result 3x3");
  has(message(result(), {.compression = "best"}), "--compression is 'best'");
  ASSERT_TRUE(add_to_exr(path("c.exr"), path("a.exr"), result(), {}).ok());
  Status s = add_to_exr(path("d.exr"), path("c.exr"), result(), {});
  has(s.message(), "has a channel visibility already; give --replace");
  s = add_to_exr(path("d.exr"), path("c.exr"), result(), {.replace = true});
  EXPECT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(bytes_of(path("d.exr")), bytes_of(path("c.exr")));
  EXPECT_EQ(bytes_of(path("a.exr")), before);
}

}  // namespace
}  // namespace obscura::tools
