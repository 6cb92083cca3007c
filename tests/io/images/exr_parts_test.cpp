#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>

#include "io/images/depth_file.h"
#include "io/images/exr.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// A part per name and channel, all of 4x2 pixels; part i holds i + 1.
void write_parts(const std::string& path,
                 const std::vector<std::pair<std::string, std::string>>& parts) {
  std::vector<Imf::Header> headers;
  for (const auto& [name, channel] : parts) {
    Imf::Header& h = headers.emplace_back(4, 2);
    h.setName(name);
    h.setType(Imf::SCANLINEIMAGE);
    h.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    const std::vector<float> values(8, static_cast<float>(i + 1));
    Imf::FrameBuffer frame;
    frame.insert(parts[i].second,
                 Imf::Slice::Make(Imf::FLOAT, values.data(), headers[i].dataWindow()));
    Imf::OutputPart part(file, i);
    part.setFrameBuffer(frame);
    part.writePixels(2);
  }
}

TEST_F(FilesTest, TheFirstPartWithDepthIsReadAndNamed) {
  write_parts(path("p.exr"), {{"rgba", "R"}, {"depth", "Z"}, {"more", "Z"}});
  DepthFileOptions o;
  o.fov_y = 50;
  DepthInput input;
  Status s = load_depth_input(path("p.exr"), o, &input);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(input.depth[0], 2);
  ASSERT_EQ(input.notes.size(), 1u);
  EXPECT_NE(input.notes[0].find("number 1, depth"), std::string::npos) << input.notes[0];
  for (const auto& [part, value] : {std::pair{"2", 3.0f}, {"more", 3.0f}, {"depth", 2.0f}}) {
    o.part = part;
    ASSERT_TRUE(load_depth_input(path("p.exr"), o, &input).ok());
    EXPECT_EQ(input.depth[0], value) << part;
  }
  for (const char* part : {"3", "-1", "x", "1.5"}) {
    o.part = part;
    s = load_depth_input(path("p.exr"), o, &input);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput) << part;
    EXPECT_NE(s.message().find("0 rgba (R), 1 depth (Z), 2 more (Z)"), std::string::npos)
        << s.message();
  }
  write_parts(path("p.exr"), {{"rgba", "R"}, {"other", "G"}});
  o.part.clear();
  s = load_depth_input(path("p.exr"), o, &input);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find("none of its parts has depth"), std::string::npos) << s.message();
}

// Pixels of a row with 0, 1, 2 and 3 samples of Z and ZBack, the last two of which touch.
void write_deep(const std::string& path, bool backs) {
  Imf::Header header(4, 1);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  if (backs) header.channels().insert("ZBack", Imf::Channel(Imf::FLOAT));
  std::vector<unsigned> counts{0, 1, 2, 3};
  // Not in order of depth.
  std::vector<std::vector<float>> z{{}, {2}, {5, 3}, {4, 1, 2}}, b{{}, {2.5f}, {6, 4}, {5, 2, 3}};
  std::vector<float*> at_z, at_b;
  for (int i = 0; i < 4; ++i) {
    at_z.push_back(z[i].data());
    at_b.push_back(b[i].data());
  }
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(unsigned), 0));
  auto deep = [](std::vector<float*>& at) {
    return Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(at.data()), sizeof(float*), 0,
                          sizeof(float));
  };
  frame.insert("Z", deep(at_z));
  if (backs) frame.insert("ZBack", deep(at_b));
  Imf::DeepScanLineOutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(1);
}

TEST_F(FilesTest, DeepImagesAreDepthLayers) {
  write_deep(path("d.exr"), true);
  DepthFileOptions o;
  o.fov_y = 50;
  o.layers = 8;
  DepthInput input;
  const Status s = load_depth_input(path("d.exr"), o, &input);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(input.depth, (std::vector<float>{kInf, 2, 3, 1}));
  EXPECT_EQ(input.back_depth, (std::vector<float>{kInf, 2.5f, 4, 3}));
  ASSERT_EQ(input.layers.size(), 2u);
  EXPECT_EQ(input.layers[1].front, (std::vector<float>{kInf, kInf, 5, 4}));
  EXPECT_EQ(input.layers[1].back, (std::vector<float>{kInf, kInf, 6, 5}));
  // Without the backs there is only depth.
  write_deep(path("d.exr"), false);
  ASSERT_TRUE(load_depth_input(path("d.exr"), o, &input).ok());
  EXPECT_EQ(input.depth, (std::vector<float>{kInf, 2, 3, 1}));
  EXPECT_TRUE(input.back_depth.empty());
  EXPECT_TRUE(input.layers.empty());
  // Every cut is refused, none crashes.
  const std::string whole = content("d.exr");
  for (std::size_t keep = 0; keep < whole.size(); keep += 3) {
    write("cut.exr", whole.substr(0, keep));
    EXPECT_FALSE(load_depth_input(path("cut.exr"), o, &input).ok()) << keep;
  }
}

}  // namespace
}  // namespace obscura::tools
