#include <cmath>
#include <cstring>
#include <filesystem>
#include <vector>

#include "io/rasters/gdal.h"
#include "io/rasters/hull_file.h"
#include "tests/command/run_command.h"

// obscura terrain --memory: bands of rows.
namespace obscura {
namespace {

class TerrainBandsCommand : public CommandTest {
 protected:
  // Mountains of 1000x4000 cells as a file of floats with a header for GDAL.
  void write_mountains() {
    std::vector<float> z;
    for (int y = 0; y < 4000; ++y) {
      for (int x = 0; x < 1000; ++x) {
        const double u = 0.013 * x, v = 0.011 * y;
        z.push_back(float(900 + 500 * std::sin(u + 0.7 * v) * std::cos(v - 0.2 * u) +
                          60 * std::sin(9.1 * u) * std::cos(7.3 * v)));
      }
    }
    for (int i = 0; i < 4000; ++i) z[std::size_t(i) * 1000 + (i * 7) % 1000] = -9999;
    write("in.bin", std::string(reinterpret_cast<const char*>(z.data()), z.size() * 4));
    write("in.hdr",
          "ENVI\nsamples = 1000\nlines = 4000\nbands = 1\nheader offset = 0\ndata type = 4\n"
          "interleave = bsq\nbyte order = 0\ndata ignore value = -9999\n"
          "map info = {Arbitrary, 1, 1, 0, 0, 30, 30, 0}\n");
  }
  std::vector<float> band(const std::string& file, int index) {
    tools::Raster raster;
    tools::RasterOptions options;
    options.band = index;
    options.z_factor = 1;
    EXPECT_TRUE(tools::read_raster(path(file), options, &raster).ok());
    return raster.heights;
  }
  // The least memory that the command takes, as it says itself.
  std::string least_memory(const std::string& line) {
    const CommandResult r = run(line + "none.tif --memory 90M");
    const std::string before = "give at least ";
    const auto at = r.err.find(before);
    EXPECT_NE(at, std::string::npos) << r.err;
    return at == std::string::npos ? "1G" : r.err.substr(at + before.size(), 4);
  }
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(TerrainBandsCommand, HaveTheBitsOfTheWholeAlsoWhenKilled) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write_mountains();
  const std::string line = "terrain in.bin -q --quantity svf,openness --azimuths 8 -o ";
  expect_success(line + "whole.tif");
  const std::string memory = " --memory " + least_memory(line);
  // Killed on the way down and on the way up.
  for (const char* part : {"down-40.f32", "up-150.f32"}) {
    const std::string file = std::string("bands.tif.bands/") + part;
    const std::string line_and = line + "bands.tif" + memory + " & p=$!; while [ ! -e " + file +
                                 " ] && kill -0 $p; do sleep 0.01; done; kill -9 $p; wait $p";
    // `run` puts its redirections behind the last command.
    const std::string script = "cd '" + folder_ + "'; '" OBSCURA_COMMAND "' " + line_and;
    ASSERT_NE(std::system((script + " 2>/dev/null").c_str()), 0);
    EXPECT_TRUE(std::filesystem::exists(path(file)));
    EXPECT_FALSE(std::filesystem::exists(path("bands.tif")));
  }
  expect_failure(line + "bands.tif --memory 175M", 2, "holds parts of another run");
  expect_success(line + "bands.tif" + memory);
  EXPECT_FALSE(std::filesystem::exists(path("bands.tif.bands")));
  for (const int index : {1, 2}) {
    EXPECT_TRUE(same_bits(band("whole.tif", index), band("bands.tif", index)));
  }
}

TEST_F(TerrainBandsCommand, LostFilesAndFullDisksAreNamed) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write_mountains();
  const std::string line = "terrain in.bin -q --azimuths 8 --quantity svf,openness -o out.tif";
  const std::string memory = " --memory " + least_memory(line.substr(0, line.size() - 7));
  expect_failure(line + memory, 1, "cannot write out.tif.bands/down-0.hulls: File too large",
                 "ulimit -f 16;");
  EXPECT_FALSE(std::filesystem::exists(path("out.tif")));
  std::filesystem::remove_all(path("out.tif.bands"));
  // Long finite radii are computed in tiles instead.
  expect_success(line + " --radius 40px --memory 180M");
  EXPECT_TRUE(std::filesystem::exists(path("out.tif")));
}

TEST(HullFile, GivesWhatWasPut) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("obscura-hulls-" + std::to_string(getpid())))
          .string();
  auto hull = [](int sweep, int column) {
    std::vector<TerrainHullPoint> points;
    for (int i = 0; i < (sweep * 7 + column * 3) % 11; ++i) {
      points.push_back({float(sweep + 0.25 * i), column * 100 - i});
    }
    return points;
  };
  {
    tools::HullFile out(path, 50);
    ASSERT_TRUE(out.create().ok());
    for (const int sweep : {0, 3, 4, 1000}) {
      ASSERT_TRUE(out.begin(sweep).ok());
      for (int c = 49; c >= 0; c -= 2) ASSERT_TRUE(out.put(c, hull(sweep, c)).ok());
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    ASSERT_TRUE(out.finish().ok());
  }
  auto expect = [&](int sweep, int column, bool there) {
    tools::HullFile in(path, 50);
    ASSERT_TRUE(in.load().ok());
    std::vector<TerrainHullPoint> points;
    ASSERT_TRUE(in.begin(sweep).ok());
    ASSERT_TRUE(in.get(column, &points).ok());
    const auto expected = there ? hull(sweep, column) : std::vector<TerrainHullPoint>();
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].height, expected[i].height);
      EXPECT_EQ(points[i].row, expected[i].row);
    }
  };
  for (const int sweep : {1000, 0, 4, 3}) {
    expect(sweep, 49, true);
    expect(sweep, 31, true);
    expect(sweep, 30, false);
  }
  tools::HullFile other(path, 51);
  EXPECT_NE(other.load().message().find("damaged"), std::string::npos);
  tools::HullFile in(path, 50);
  ASSERT_TRUE(in.load().ok());
  EXPECT_FALSE(in.begin(2).ok());
  // Cut off and with other bytes: a message, never more memory than the file is long.
  const std::string bytes = read_file(path);
  for (std::size_t i = 0; i <= bytes.size(); i += 61) {
    for (const bool cut : {false, true}) {
      std::string wrong = bytes;
      if (cut) {
        wrong.resize(i);
      } else if (i + 8 <= wrong.size()) {
        wrong.replace(i, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");
      }
      std::ofstream(path, std::ios::binary) << wrong;
      tools::HullFile file(path, 50);
      if (!file.load().ok() || !file.begin(4).ok()) continue;
      EXPECT_FALSE(cut && i < bytes.size());
      std::vector<TerrainHullPoint> points;
      for (int c = 0; c < 50; ++c) {
        (void)file.get(c, &points);
        EXPECT_LE(points.size() * sizeof(TerrainHullPoint), bytes.size());
      }
    }
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace obscura
