#include <chrono>

#include "core/random.h"
#include "io/volumes/nrrd.h"
#include "io/volumes/vdb.h"
#include "tests/scene/volumes/volume_files.h"

// Several things in one file, files in several parts, spellings, and what damage does to OpenVDB.
namespace obscura::tools {
namespace {

using ContainersTest = VolumeFileTest;

TEST_F(ContainersTest, EverySpellingOfNrrdTypesIsRead) {
  const std::pair<int, std::vector<const char*>> kTypes[] = {
      {1, {"signed char", "int8", "int8_t", "uchar", "unsigned char", "uint8", "uint8_t"}},
      {2,
       {"short", "short int", "signed short", "signed short int", "int16", "int16_t", "ushort",
        "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {4, {"int", "signed int", "int32", "int32_t", "uint", "unsigned int", "uint32", "uint32_t"}},
      {8,
       {"longlong", "long long", "long long int", "signed long long", "signed long long int",
        "int64", "int64_t", "ulonglong", "unsigned long long", "unsigned long long int", "uint64",
        "uint64_t"}}};
  for (const auto& [bytes, names] : kTypes) {
    std::string data(2 * bytes, '\0');
    data[bytes] = 100;  // the second sample's low byte
    for (const char* name : names) {
      const std::string header = std::string("NRRD0004\ntype: ") + name +
                                 "\ndimension: 3\nsizes: 2 1 1\nendian: little\nencoding: raw\n\n";
      VolumeImage image;
      const Status s = load_volume(write("t.nrrd", header + data), {}, &image);
      ASSERT_TRUE(s.ok()) << name << s.message();
      EXPECT_EQ(value_at(image, 0, 0, 0), 0) << name;
      EXPECT_EQ(value_at(image, 1, 0, 0), 100) << name;
    }
  }
}

TEST_F(ContainersTest, NrrdAxesOfLengthOneAreLeftOut) {
  const std::string tail = "encoding: raw\n\n" + std::string("\1\2\3\4\5\6", 6);
  for (const char* axes :
       {"dimension: 4\nsizes: 1 3 2 1\nspacings: nan 1 2 3\n",
        "dimension: 4\nsizes: 3 1 2 1\nspacings: 1 nan 2 3\n",
        "dimension: 4\nsizes: 1 3 2 1\nspace directions: none (1,0,0) (0,2,0) (0,0,3)\n",
        "dimension: 5\nsizes: 1 1 3 2 1\nspacings: nan nan 1 2 3\n"}) {
    VolumeImage image;
    const Status s = load_volume(
        write("d.nrrd", std::string("NRRD0004\ntype: uchar\n") + axes + tail), {}, &image);
    ASSERT_TRUE(s.ok()) << axes << s.message();
    EXPECT_EQ(image.size, (std::array{3, 2, 1})) << axes;
    EXPECT_EQ(image.spacing(), (Double3{1, 2, 3})) << axes;
    EXPECT_EQ(value_at(image, 1, 1, 0), 5);
  }
  expect_refused(write("c.nrrd", "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\n" + tail),
                 "three axes longer than one");
}

TEST_F(ContainersTest, NrrdSlicesInFilesOfTheirOwn) {
  const std::string head =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 1 3\nencoding: raw\nbyte skip: 1\n";
  for (const auto& [name, bytes] :
       {std::pair{"s07.raw", "xab"}, {"s09.raw", "xcd"}, {"s11.raw", "xef"}}) {
    write(name, bytes);
  }
  for (const char* files : {"data file: LIST\ns07.raw\ns09.raw\ns11.raw\n",
                            "data file: s%02d.raw 7 11 2\n", "data file: s%02d.raw 7 11 2 2\n"}) {
    VolumeImage image;
    const Status s = load_volume(write("l.nhdr", head + files), {}, &image);
    ASSERT_TRUE(s.ok()) << files << s.message();
    EXPECT_EQ(value_at(image, 0, 0, 0), 'a');
    EXPECT_EQ(value_at(image, 1, 0, 1), 'd');
    EXPECT_EQ(value_at(image, 0, 0, 2), 'e');
  }
  expect_refused(write("l.nhdr", head + "data file: LIST\n"), "no file follows");
  expect_refused(write("l.nhdr", head + "data file: LIST\ns07.raw\ns09.raw\n"), "share");
  expect_refused(write("l.nhdr", head + "data file: s%s.raw 7 11 2\n"), "FIRST LAST STEP");
  expect_refused(write("l.nhdr", head + "data file: s%02d.raw 7 900000 1\n"), "FIRST LAST STEP");
  expect_refused(write("l.nhdr", head + "data file: s%n%d.raw 7 9 1\n"), "FIRST LAST STEP");
}

class VdbTest : public VolumeFileTest {
 protected:
  void SetUp() override {
    if (!has_openvdb()) GTEST_SKIP() << "this build has no OpenVDB";
  }
  static FieldGrid grid() {
    FieldGrid g;
    g.size = {20, 9, 9};
    g.axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    return g;
  }
  static NamedField field(const char* name, float low, float high) {
    NamedField f{name, std::vector<float>(20 * 9 * 9, low)};
    for (std::size_t i = 0; i < f.values.size(); i += 3) f.values[i] = high;
    return f;
  }
};

TEST_F(VdbTest, TheGridThatFitsIsReadAndNamed) {
  const std::vector<NamedField> fields = {field("flat", 1, 1), field("heat", 0, 2),
                                          field("density", 0, 3)};
  ASSERT_TRUE(write_vdb(path("g.vdb"), grid(), fields).ok());
  VolumeImage image;
  ASSERT_TRUE(load_volume(path("g.vdb"), {}, &image).ok());
  EXPECT_EQ(value_at(image, 0, 0, 0), 3);
  ASSERT_EQ(image.notes.size(), 1u);
  for (const char* name : {"flat", "heat", "density is read"}) {
    EXPECT_NE(image.notes[0].find(name), std::string::npos) << image.notes[0];
  }
  ASSERT_TRUE(load_volume(path("g.vdb"), {}, &image, 0, {"flat", {}}).ok());
  EXPECT_EQ(value_at(image, 0, 0, 0), 1);
  EXPECT_EQ(load_volume(path("g.vdb"), {}, &image, 0, {"x", {}}).code(), StatusCode::kInvalidInput);
  ASSERT_TRUE(write_vdb(path("h.vdb"), grid(), std::span(fields).first(2)).ok());
  ASSERT_TRUE(load_volume(path("h.vdb"), {}, &image).ok());
  EXPECT_EQ(value_at(image, 0, 0, 0), 2);
  EXPECT_FALSE(load_volume("volume:gyroid", {}, &image, 0, {"x", {}}).ok());
}

// Cut and changed anywhere, a file is refused in a line, or read, within seconds.
TEST_F(VdbTest, DamageEndsInALine) {
  ASSERT_TRUE(write_vdb(path("g.vdb"), grid(), {{field("density", 0, 3)}}).ok());
  std::ifstream in(path("g.vdb"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    std::string bytes = whole;
    if (i % 2 == 0) bytes.resize(random.below(static_cast<int>(whole.size())));
    for (int k = 0; k < 3 && !bytes.empty(); ++k) {
      const int at = random.below(std::min(static_cast<int>(bytes.size()), i < 30 ? 600 : 100000));
      bytes[at] = static_cast<char>(random.below(256));
    }
    const auto start = std::chrono::steady_clock::now();
    VolumeImage image;
    const Status s = load_volume(write("d.vdb", bytes), {}, &image);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), 10);
    EXPECT_EQ(s.message().find('\n'), std::string::npos);
    EXPECT_LE(s.message().size(), 500u);
  }
}

}  // namespace
}  // namespace obscura::tools
