#include <cmath>

#include "paths.h"
#include "tests/scene/volumes/volume_files.h"

namespace obscura::tools {
namespace {

using NiftiTest = VolumeFileTest;

std::string ramp(int count) {
  std::string data;
  for (int i = 0; i < count; ++i) data.push_back(char(i));
  return data;
}

TEST_F(NiftiTest, SlopeInterceptAndSpacing) {
  NiftiBytes header(2, 3, 4, 2);
  header.put<float>(80, 0.5f).put<float>(84, 2).put<float>(88, 3);
  header.put<float>(112, 10).put<float>(116, -7);
  for (const std::string& file :
       {write("a.nii", header.with(ramp(24))), write_gzip("a.nii.gz", header.with(ramp(24)))}) {
    VolumeImage image;
    const Status s = load_volume(file, {}, &image);
    ASSERT_TRUE(s.ok()) << s.message();
    EXPECT_EQ(image.type, VoxelType::kU8);
    EXPECT_EQ(image.size, (std::array{2, 3, 4}));
    EXPECT_EQ(image.spacing(), (Double3{0.5, 2, 3}));
    EXPECT_EQ(value_at(image, 1, 2, 3), 10 * 23 - 7);
    EXPECT_EQ(value_at(image, 1, 0, 0), 10 * 1 - 7);
  }
}

TEST_F(NiftiTest, OneOfSeveralVolumesIsRead) {
  NiftiBytes header(2, 3, 1, 2);
  header.put<std::int16_t>(40, 5).put<std::int16_t>(48, 2).put<std::int16_t>(50, 2);  // 2 x 2
  const std::string data = ramp(24);
  for (const std::string& file :
       {write("a.nii", header.with(data)), write_gzip("a.nii.gz", header.with(data))}) {
    for (const int index : {0, 1, 3}) {
      VolumeImage image;
      const Status s = load_volume(file, {}, &image, 0, {"", index});
      ASSERT_TRUE(s.ok()) << s.message();
      EXPECT_EQ(value_at(image, 1, 2, 0), 6 * index + 5);
      ASSERT_EQ(image.notes.size(), 1u);
      EXPECT_NE(image.notes[0].find("--volume-index"), std::string::npos);
    }
    VolumeImage image;
    EXPECT_FALSE(load_volume(file, {}, &image, 0, {"", 4}).ok());
    EXPECT_FALSE(load_volume("volume:gyroid", {}, &image, 0, {"", 0}).ok());
  }
}

// A spacing of 0 is no spacing, but where there is one voxel.
TEST_F(NiftiTest, SpacingOfZeroOrNearlyZero) {
  NiftiBytes flat(2, 3, 1, 2);
  flat.put<float>(88, 0);
  VolumeImage image;
  ASSERT_TRUE(load_volume(write("flat.nii", flat.with(ramp(6))), {}, &image).ok());
  EXPECT_EQ(image.spacing(), (Double3{1, 1, 1}));
  for (const float spacing : {0.0f, 1e-30f}) {
    NiftiBytes header(2, 3, 4, 2);
    header.put<float>(84, spacing);
    expect_refused(write("a.nii", header.with(ramp(24))), "spacing along y");
  }
}

TEST_F(NiftiTest, EveryTypeAndByteOrder) {
  const std::vector<std::pair<int, int>> types = {{4, 2},  {512, 2}, {8, 4},    {768, 4}, {16, 4},
                                                  {64, 8}, {256, 1}, {1024, 8}, {1280, 8}};
  for (const auto& [datatype, width] : types) {
    for (const bool big : {false, true}) {
      NiftiBytes header(2, 1, 1, datatype, big);
      NiftiBytes samples(1, 1, 1, 2, big);  // only to write numbers in its byte order
      for (int i = 0; i < 2; ++i) {
        const int at = i * width, v = 5 + i;
        if (datatype == 16) {
          samples.put<float>(at, float(v));
        } else if (datatype == 64) {
          samples.put<double>(at, v);
        } else if (width == 1) {
          samples.put<std::int8_t>(at, std::int8_t(v));
        } else if (width == 2) {
          samples.put<std::int16_t>(at, std::int16_t(v));
        } else if (width == 4) {
          samples.put<std::int32_t>(at, v);
        } else {
          samples.put<std::int64_t>(at, v);
        }
      }
      VolumeImage image;
      const Status s = load_volume(
          write("t.nii", header.with(samples.bytes.substr(0, std::size_t(2 * width)))), {}, &image);
      ASSERT_TRUE(s.ok()) << s.message();
      EXPECT_EQ(value_at(image, 0, 0, 0), 5) << datatype << big;
      EXPECT_EQ(value_at(image, 1, 0, 0), 6) << datatype << big;
    }
  }
}

TEST_F(NiftiTest, SformTurnsAndFlips) {
  // Voxel x runs to -Y of the world, y to +Z, z to -X: rows of the matrix are the world's axes.
  NiftiBytes header(2, 2, 2, 2);
  const float rows[12] = {0, 0, -3, 10, -1, 0, 0, 20, 0, 2, 0, 30};
  header.put<std::int16_t>(254, 1);
  for (int i = 0; i < 12; ++i) header.put<float>(280 + 4 * i, rows[i]);
  VolumeImage image;
  ASSERT_TRUE(load_volume(write("s.nii", header.with(ramp(8))), {}, &image).ok());
  EXPECT_EQ(image.spacing(), (Double3{1, 2, 3}));
  EXPECT_EQ(image.to_world({1, 2, 3}), (Double3{7, 19, 32}));
  EXPECT_EQ(image.to_grid({7, 19, 32}), (Double3{1, 2, 3}));
}

TEST_F(NiftiTest, QformTurnsByAQuaternion) {
  // Half a turn around z, and a flip of the z axis.
  NiftiBytes header(2, 2, 2, 2);
  header.put<float>(76, -1).put<float>(88, 2);
  header.put<std::int16_t>(252, 1);
  header.put<float>(264, 1);   // quatern_d
  header.put<float>(268, 50);  // qoffset_x
  VolumeImage image;
  ASSERT_TRUE(load_volume(write("q.nii", header.with(ramp(8))), {}, &image).ok());
  const Double3 w = image.to_world({1, 1, 2});
  EXPECT_NEAR(w[0], 49, 1e-6);
  EXPECT_NEAR(w[1], -1, 1e-6);
  EXPECT_NEAR(w[2], -2, 1e-6);
}

TEST_F(NiftiTest, DamagedFilesAreRefused) {
  const NiftiBytes good(4, 4, 4, 2);
  expect_refused(path("none.nii"), "cannot read");
  expect_refused(write("empty.nii", ""), "empty");
  expect_refused(write("short.nii", good.bytes.substr(0, 100)), "ends after");
  expect_refused(write("junk.nii", std::string(400, 'x')), "is not NIfTI");
  expect_refused(write("cut.nii", good.with(ramp(63))), "promises 4x4x4");
  expect_refused(write("nomagic.nii", NiftiBytes(good).put<int>(344, 0).with(ramp(64))), "magic");
  expect_refused(write("type.nii", NiftiBytes(4, 4, 4, 128).with(ramp(64))), "datatype is 128");
  expect_refused(write("huge.nii", NiftiBytes(32767, 32767, 32767, 64).with(ramp(64))),
                 "must be in [1, 8192]");
  expect_refused(write("big.nii", NiftiBytes(8192, 8192, 8192, 64).with(ramp(64))), "promises");
  expect_refused(write("zero.nii", NiftiBytes(4, 0, 4, 2).with(ramp(64))), "is 0 voxels");
  expect_refused(write("neg.nii", NiftiBytes(4, -4, 4, 2).with(ramp(64))), "must be in [1, 8192]");
  expect_refused(write("dims.nii", NiftiBytes(good).put<std::int16_t>(40, 9).with(ramp(64))),
                 "dim[0] is 9");
  expect_refused(write("offset.nii", NiftiBytes(good).put<float>(108, 1e9f).with(ramp(64))),
                 "beyond its end");
  expect_refused(write("nan.nii", NiftiBytes(good).put<float>(108, NAN).with(ramp(64))),
                 "vox_offset");
  expect_refused(write("spacing.nii", NiftiBytes(good).put<float>(84, INFINITY).with(ramp(64))),
                 "spacing along y");
}

TEST_F(NiftiTest, ShearIsRefused) {
  NiftiBytes header(2, 2, 2, 2);
  const float rows[12] = {1, 0.5f, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  header.put<std::int16_t>(254, 1);
  for (int i = 0; i < 12; ++i) header.put<float>(280 + 4 * i, rows[i]);
  expect_refused(write("shear.nii", header.with(ramp(8))), "right angles");
}

TEST_F(NiftiTest, DamagedGzipIsRefused) {
  std::string noise;
  for (unsigned i = 0, v = 1; i < 64 * 64 * 64; ++i) {
    v = v * 1664525u + 1013904223u;
    noise.push_back(char(v >> 24));
  }
  const std::string file = write_gzip("n.nii.gz", NiftiBytes(64, 64, 64, 2).with(noise));
  VolumeImage image;
  ASSERT_TRUE(load_volume(file, {}, &image).ok());
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  expect_refused(write("cut.nii.gz", bytes.substr(0, bytes.size() / 2)), "cut.nii.gz");
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 4000; ++i) bytes[i] = 'x';
  expect_refused(write("bad.nii.gz", bytes), "bad.nii.gz");
}

TEST_F(NiftiTest, SharedVolumes) {
  const std::string folder = OBSCURA_SOURCE_DIR "/../shared/data/volumes/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  VolumeImage image;
  ASSERT_TRUE(load_volume(folder + "MR.nii.gz", {}, &image).ok());
  EXPECT_EQ(image.size, (std::array{160, 232, 160}));
  EXPECT_NEAR(image.spacing()[0], 1.0, 1e-3);
  EXPECT_NEAR(image.spacing()[1], 0.898, 1e-3);
}

}  // namespace
}  // namespace obscura::tools
