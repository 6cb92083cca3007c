#include <cmath>
#include <cstring>
#include <filesystem>
#include <vector>

#include "io/images/files.h"
#include "io/rasters/gdal.h"
#include "tests/command/run_command.h"

// obscura terrain on rasters that are empty, tiny, damaged or lie.
namespace obscura {
namespace {

class TerrainHostile : public CommandTest {
 protected:
  void SetUp() override {
    if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  }
  // A file of plain numbers with a header that GDAL reads; `type` is ENVI's.
  template <class T>
  void write_raw(int width, int height, int type, const std::vector<T>& values,
                 const std::string& more = "") {
    write("in.bin",
          std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
    std::ostringstream header;
    header << "ENVI\nsamples = " << width << "\nlines = " << height
           << "\nbands = 1\nheader offset = 0\ndata type = " << type
           << "\ninterleave = bsq\nbyte order = 0\nmap info = {Arbitrary, 1, 1, 0, 0, 10, 10, 0}\n"
           << more;
    write("in.hdr", header.str());
  }
  std::vector<float> result(const std::string& options, const std::string& input = "in.bin") {
    expect_success("terrain " + input + " -o out.pfm -q " + options);
    tools::Image image;
    EXPECT_TRUE(tools::read_image(path("out.pfm"), &image).ok());
    return image.channels.empty() ? std::vector<float>() : image.channels[0].values;
  }
  std::vector<float> first_band(const std::string& file) {
    tools::Raster raster;
    tools::RasterOptions options;
    options.band = 1;
    options.z_factor = 1;
    EXPECT_TRUE(tools::read_raster(path(file), options, &raster).ok());
    return raster.heights;
  }
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(TerrainHostile, TheLeastModels) {
  for (const auto& size : {std::array{1, 1}, {7, 1}, {1, 7}}) {
    write_raw<float>(size[0], size[1], 4, std::vector<float>(size[0] * size[1], 5));
    for (const auto& [quantity, value] : {std::pair{"svf", 1.0f},
                                          {"svf-normal", 1.0f},
                                          {"svf-cosine", 1.0f},
                                          {"asvf", 1.0f},
                                          {"openness", 90.0f},
                                          {"negative-openness", 90.0f},
                                          {"visible-sky", 100.0f}}) {
      const auto values = result(std::string("--quantity ") + quantity);
      EXPECT_EQ(values.size(), std::size_t(size[0] * size[1]));
      for (const float v : values) EXPECT_NEAR(v, value, 1e-5f * value) << quantity;
    }
    // No cell lies in the ring that it looks at.
    for (const float v : result("--quantity local-dominance")) EXPECT_TRUE(std::isnan(v));
    EXPECT_EQ(result("--quantity horizon --azimuths 1").size(), std::size_t(size[0] * size[1]));
  }
  // One row rises to the east: only the west is open above it.
  write_raw<float>(9, 1, 4, {0, 10, 20, 30, 40, 50, 60, 70, 80});
  const auto row = result("--azimuths 4");
  for (int x = 0; x < 8; ++x) EXPECT_NEAR(row[x], 1 - std::sqrt(0.5) / 4, 1e-5);
  EXPECT_NEAR(row[8], 1, 1e-6);
}

TEST_F(TerrainHostile, NothingButHoles) {
  for (const float none :
       {-9999.0f, 3.4028234663852886e38f, -3.4028234663852886e38f,
        std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    write_raw<float>(30, 20, 4, std::vector<float>(600, none));
    const std::string nodata = none == -9999 ? " --nodata -9999" : "";
    for (const char* quantity : {"svf", "openness", "local-dominance", "svf-normal"}) {
      for (const float v : result(std::string("--quantity ") + quantity + nodata)) {
        ASSERT_TRUE(std::isnan(v)) << none;
      }
    }
    expect_success("terrain in.bin -o tiles.tif -q --tile 64" + nodata);
    for (const float v : first_band("tiles.tif")) ASSERT_TRUE(std::isnan(v)) << none;
  }
}

// Spikes that are no heights neither hide the sky nor spoil what is beside them.
TEST_F(TerrainHostile, InfiniteSpikesAreHoles) {
  std::vector<float> flat(40 * 30, 100), spikes = flat;
  const float values[] = {INFINITY, -INFINITY, 3e38f, -3e38f, 2e9f, NAN};
  for (int i = 0; i < 6; ++i) spikes[(4 + 4 * i) * 40 + 5 + 5 * i] = values[i];
  write_raw<float>(40, 30, 4, spikes);
  for (const char* quantity : {"svf", "svf-normal", "visible-sky", "openness"}) {
    const auto seen = result(std::string("--quantity ") + quantity);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (spikes[i] != 100) {
        EXPECT_TRUE(std::isnan(seen[i]));
      } else {
        EXPECT_NEAR(seen[i], seen[0], 1e-4f) << quantity << " " << i;
      }
    }
  }
  // The highest cell that is a height is seen as one.
  spikes = flat;
  spikes[15 * 40 + 20] = 9e8f;
  write_raw<float>(40, 30, 4, spikes);
  EXPECT_NEAR(result("--quantity horizon --azimuths 1")[16 * 40 + 20], 90, 1e-3);
}

TEST_F(TerrainHostile, EveryTypeOfNumber) {
  std::vector<double> heights;
  for (int i = 0; i < 30 * 20; ++i) heights.push_back(100 + (i * 37) % 71);
  write_raw<double>(30, 20, 5, heights);
  const auto expected = result("");
  auto expect_same = [&](auto zero, int type) {
    std::vector<decltype(zero)> values;
    for (const double h : heights) values.push_back(decltype(zero)(h));
    write_raw(30, 20, type, values);
    EXPECT_TRUE(same_bits(result(""), expected)) << type;
  };
  expect_same(std::uint8_t{}, 1);
  expect_same(std::int16_t{}, 2);
  expect_same(std::int32_t{}, 3);
  expect_same(float{}, 4);
  expect_same(std::uint16_t{}, 12);
  expect_same(std::uint32_t{}, 13);
  // 2 billion and a few metres: floats of 128 metres would lose them if they were not first scaled.
  std::vector<std::int32_t> far;
  for (const double h : heights) far.push_back(2000000000 + int(h));
  write_raw(30, 20, 3, far);
  write("in.vrt",
        "<VRTDataset rasterXSize=\"30\" rasterYSize=\"20\"><GeoTransform>0, 10, 0, 0, 0, -10"
        "</GeoTransform><VRTRasterBand dataType=\"Int32\" band=\"1\"><Offset>-2000000000</Offset>"
        "<Scale>1</Scale><SimpleSource><SourceFilename relativeToVRT=\"1\">in.bin</SourceFilename>"
        "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  EXPECT_TRUE(same_bits(result("", "in.vrt"), expected));
}

// Holes that several tiles see in their halos.
TEST_F(TerrainHostile, HolesInTheHalo) {
  std::vector<float> z;
  for (int i = 0; i < 200 * 150; ++i) {
    const int x = i % 200, y = i / 200;
    const bool hole = (x > 50 && x < 90 && y > 40 && y < 100) || (x + 3 * y) % 97 == 0;
    z.push_back(hole ? -9999 : float(60 * std::sin(x * 0.11) * std::cos(y * 0.17) + (x * y) % 13));
  }
  write_raw<float>(200, 150, 4, z, "data ignore value = -9999\n");
  for (const char* options : {"", " --radius 30px", " --radius 9px", " --curvature"}) {
    expect_success(std::string("terrain in.bin -q -o whole.tif") + options);
    expect_success(std::string("terrain in.bin -q -o tiles.tif --tile 64") + options);
    EXPECT_TRUE(same_bits(first_band("whole.tif"), first_band("tiles.tif"))) << options;
  }
}

// What a raster's numbers are measured at moves it by half a cell, in and out.
TEST_F(TerrainHostile, PixelIsPoint) {
  write_raw<float>(8, 6, 4, std::vector<float>(48, 1));
  auto widths = [&](const std::string& file) {
    tools::Raster raster;
    EXPECT_TRUE(tools::read_raster(path(file), {}, &raster).ok());
    return raster.row_widths;
  };
  std::vector<std::vector<double>> of_kind;
  for (const char* kind : {"Area", "Point"}) {
    write("in.vrt",
          "<VRTDataset rasterXSize=\"8\" rasterYSize=\"6\"><SRS>EPSG:4326</SRS><GeoTransform>10, "
          "0.5, 0, 60, 0, -0.5</GeoTransform><Metadata><MDI key=\"AREA_OR_POINT\">" +
              std::string(kind) +
              "</MDI></Metadata><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
              "<SourceFilename relativeToVRT=\"1\">in.bin</SourceFilename><SourceBand>1"
              "</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
    expect_success("terrain in.vrt -q -o once.tif");
    expect_success("terrain once.tif -q -o twice.tif");
    EXPECT_EQ(widths("once.tif"), widths("in.vrt"));
    EXPECT_EQ(widths("twice.tif"), widths("in.vrt"));
  }
}

TEST_F(TerrainHostile, ModelsThatNoMachineHolds) {
  auto huge = [&](int side) {
    const std::string n = std::to_string(side);
    write("in.vrt", "<VRTDataset rasterXSize=\"" + n + "\" rasterYSize=\"" + n +
                        "\"><GeoTransform>0, 1, 0, 0, 0, -1</GeoTransform><VRTRasterBand "
                        "dataType=\"Float32\" band=\"1\"></VRTRasterBand></VRTDataset>");
  };
  huge(900000);
  const std::string line = "terrain in.vrt -q -o x.tif";
  expect_failure(line, 3, "more than this machine has");
  expect_failure(line + " --tile 4096", 3, "lacks some of the cells");
  expect_failure(line + " --nodata none --memory 2G", 3, "--memory computes up to 262144 a side");
  huge(262144);
  expect_failure(line + " --memory 100M", 3, "lacks some of the cells");
  expect_failure(line + " --nodata none --memory 100M", 2,
                 "do not hold a band of rows; give at least");
  EXPECT_FALSE(std::filesystem::exists(path("x.tif.bands")));
  EXPECT_FALSE(std::filesystem::exists(path("x.tif.tiles")));
}

TEST_F(TerrainHostile, NetworksBehindFiles) {
  auto vrt = [&](const std::string& name, const std::string& source) {
    write(name,
          "<VRTDataset rasterXSize=\"8\" rasterYSize=\"6\"><GeoTransform>0, 1, 0, 0, 0, -1"
          "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
          "<SourceFilename>" +
              source +
              "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>"
              "</VRTDataset>");
  };
  for (const char* source :
       {"/vsicurl/http://127.0.0.1:9/x.tif", "http://127.0.0.1:9/x.tif",
        "/vsizip//vsicurl/http://127.0.0.1:9/x.zip/x.tif", "/vsis3/b/x.tif",
        "/vsicurl_streaming/http://127.0.0.1:9/x.tif", "/vsigzip//vsicurl/http://127.0.0.1:9/x.gz",
        "WMS:http://127.0.0.1:9/x", "<GDAL_WMS></GDAL_WMS>"}) {
    std::string escaped = source;
    for (auto at = escaped.find('<'); at != escaped.npos; at = escaped.find('<')) {
      escaped.replace(at, 1, "&lt;");
    }
    vrt("inner.vrt", escaped);
    vrt("outer.vrt", path("inner.vrt"));
    for (const char* file : {"inner.vrt", "outer.vrt"}) {
      const CommandResult r = run(std::string("terrain -q -o x.tif ") + file);
      EXPECT_TRUE(r.code == 2 || r.code == 3) << source << " " << r.code << r.err;
      EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << source << r.err;
      EXPECT_FALSE(std::filesystem::exists(path("x.tif")));
    }
  }
}

}  // namespace
}  // namespace obscura
