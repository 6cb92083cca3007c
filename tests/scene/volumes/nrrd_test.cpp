#include <cmath>

#include "io/volumes/nrrd.h"
#include "io/volumes/vdb.h"
#include "tests/scene/volumes/volume_files.h"

namespace obscura::tools {
namespace {

using NrrdTest = VolumeFileTest;

const std::string kShorts = bytes_of_values<std::int16_t>({-3, 4, 500, 6, 7, 8});
const std::string kHeader =
    "NRRD0004\n# comment\ntype: short\ndimension: 3\nsizes: 3 2 1\nspacings: 1 2 3\n"
    "endian: little\nencoding: raw\n";

TEST_F(NrrdTest, AttachedDetachedZippedAndText) {
  const std::string zipped = write_gzip("data.gz", kShorts);
  std::ifstream in(zipped, std::ios::binary);
  const std::string zip((std::istreambuf_iterator<char>(in)), {});
  std::string gzip_header = kHeader, ascii_header = kHeader;
  gzip_header.replace(gzip_header.find("raw"), 3, "gzip");
  ascii_header.replace(ascii_header.find("raw"), 3, "ascii");
  write("data.raw", "skip me\nand this" + kShorts);
  const std::vector<std::string> files = {
      write("a.nrrd", kHeader + "\n" + kShorts), write("b.nrrd", gzip_header + "\n" + zip),
      write("c.nrrd", ascii_header + "\n-3 4 500\n6 7 8\n"),
      write("d.nhdr", kHeader + "line skip: 1\nbyte skip: 8\ndata file: data.raw\n"),
      write("e.nhdr", kHeader + "byte skip: -1\ndata file: data.raw\n\n")};
  for (const std::string& file : files) {
    VolumeImage image;
    const Status s = load_volume(file, {}, &image);
    ASSERT_TRUE(s.ok()) << s.message();
    EXPECT_EQ(image.size, (std::array{3, 2, 1})) << file;
    EXPECT_EQ(image.spacing(), (Double3{1, 2, 3})) << file;
    EXPECT_EQ(value_at(image, 0, 0, 0), -3) << file;
    EXPECT_EQ(value_at(image, 2, 0, 0), 500) << file;
    EXPECT_EQ(value_at(image, 2, 1, 0), 8) << file;
  }
}

TEST_F(NrrdTest, BigEndian) {
  std::string header = kHeader;
  header.replace(header.find("little"), 6, "big");
  std::string data = kShorts;
  for (std::size_t i = 0; i < data.size(); i += 2) std::swap(data[i], data[i + 1]);
  VolumeImage image;
  ASSERT_TRUE(load_volume(write("b.nrrd", header + "\n" + data), {}, &image).ok());
  EXPECT_EQ(value_at(image, 2, 0, 0), 500);
}

TEST_F(NrrdTest, LpsBecomesRas) {
  const std::string header =
      "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 1 1\n"
      "space directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (1,2,3)\nencoding: raw\n\n";
  VolumeImage image;
  const Status s = load_volume(write("l.nrrd", header + "ab"), {}, &image);
  ASSERT_TRUE(s.ok()) << s.message();
  EXPECT_EQ(image.origin, (Double3{-1, -2, 3}));
  EXPECT_EQ(image.axes[0], (Double3{-2, 0, 0}));
  EXPECT_EQ(image.axes[1], (Double3{0, -3, 0}));
  EXPECT_EQ(image.axes[2], (Double3{0, 0, 4}));
}

TEST_F(NrrdTest, DamagedFilesAreRefused) {
  auto with = [&](const std::string& key, const std::string& line) {
    std::string header = kHeader;
    const std::size_t at = header.find(key + ":");
    header.replace(at, header.find('\n', at) - at, line);
    return header + "\n" + kShorts;
  };
  expect_refused(write("a.nrrd", "nothing"), "is not NRRD");
  expect_refused(write("b.nrrd", kHeader), "no end");
  expect_refused(write("c.nrrd", kHeader + "\n" + kShorts.substr(1)), "promises 3x2x1");
  expect_refused(write("d.nrrd", with("type", "type: block")), "type is \"block\"");
  expect_refused(write("e.nrrd", with("sizes", "sizes: 3 2")), "sizes are");
  expect_refused(write("f.nrrd", with("sizes", "sizes: 3 2 1 1")), "sizes are");
  expect_refused(write("g.nrrd", with("sizes", "sizes: 99999999999999999999 2 1")), "sizes are");
  expect_refused(write("h.nrrd", with("sizes", "sizes: 8192 8192 8192")), "promises");
  expect_refused(write("i.nrrd", with("sizes", "sizes: 100000 1 1")), "must be in [1, 8192]");
  expect_refused(write("j.nrrd", with("dimension", "dimension: 4")), "sizes are");
  expect_refused(write("k.nrrd", with("encoding", "encoding: bzip2")), "encoding is \"bzip2\"");
  expect_refused(write("l.nrrd", with("endian", "endian: middle")), "endian is \"middle\"");
  expect_refused(write("m.nrrd", with("spacings", "spacings: 1 0 1")), "spacing along y");
  expect_refused(write("n.nrrd", with("spacings", "spacings: 1 x 1")), "spacings are");
  expect_refused(write("o.nrrd", with("spacings", "space directions: (1,0,0) (0,1,0) none")),
                 "space directions");
  expect_refused(write("p.nhdr", kHeader + "data file: gone.raw\n"), "gone.raw");
  expect_refused(write("q.nrrd", with("spacings", "byte skip: 1e12")), "beyond the data's end");
  expect_refused(write("r.nrrd", with("encoding", "encoding: ascii")), "not a number");
  expect_refused(write("t.nrrd", kHeader.substr(0, kHeader.find("encoding")) +
                                     "encoding: ascii\n\n1 2 3 4 567891011"),
                 "is missing");
  expect_refused(write("s.nrrd", with("spacings", "no colon here")), "without a colon");
}

FieldGrid small_grid() {
  FieldGrid grid;
  grid.size = {3, 2, 2};
  grid.axes = {{{0, 0.5, 0}, {-0.5, 0, 0}, {0, 0, 2}}};
  grid.origin = {1, 2, 3};
  return grid;
}

TEST_F(NrrdTest, FieldsComeBack) {
  const NamedField field{"distance", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  std::vector<std::string> files = {path("f.nrrd")};
  ASSERT_TRUE(write_nrrd(files[0], small_grid(), {&field, 1}).ok());
  if (has_openvdb()) {
    files.push_back(path("f.vdb"));
    ASSERT_TRUE(write_vdb(files[1], small_grid(), {&field, 1}).ok());
  }
  for (const std::string& file : files) {
    VolumeImage image;
    const Status s = load_volume(file, {}, &image);
    ASSERT_TRUE(s.ok()) << s.message();
    EXPECT_EQ(image.size, small_grid().size) << file;
    EXPECT_EQ(image.axes, small_grid().axes) << file;
    EXPECT_EQ(image.origin, small_grid().origin) << file;
    EXPECT_EQ(value_at(image, 2, 1, 1), 11) << file;
    EXPECT_EQ(value_at(image, 0, 0, 0), 0) << file;
    EXPECT_EQ(value_at(image, 1, 0, 1), 7) << file;
  }
}

TEST_F(NrrdTest, SeveralFieldsAreInterleaved) {
  const std::vector<NamedField> fields = {{"a", std::vector<float>(12, 1.0f)},
                                          {"b", std::vector<float>(12, 2.0f)}};
  ASSERT_TRUE(write_nrrd(path("two.nrrd"), small_grid(), fields).ok());
  std::ifstream in(path("two.nrrd"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(bytes.find("sizes: 2 3 2 2\n"), std::string::npos);
  float last[2];
  std::memcpy(last, bytes.data() + bytes.size() - sizeof(last), sizeof(last));
  EXPECT_EQ(last[0], 1);
  EXPECT_EQ(last[1], 2);
}

TEST_F(NrrdTest, DamagedVdbIsRefused) {
  if (!has_openvdb()) {
    expect_refused(write("x.vdb", "some"), "OBSCURA_WITH_OPENVDB");
    GTEST_SKIP() << "this build has no OpenVDB";
  }
  expect_refused(write("x.vdb", "some bytes that are no VDB file"), "cannot be read as OpenVDB");
  const NamedField field{"distance", std::vector<float>(12, 1.0f)};
  ASSERT_TRUE(write_vdb(path("f.vdb"), small_grid(), {&field, 1}).ok());
  std::ifstream in(path("f.vdb"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  expect_refused(write("cut.vdb", bytes.substr(0, bytes.size() / 2)), "cut.vdb");
}

}  // namespace
}  // namespace obscura::tools
