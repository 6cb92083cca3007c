#include <cmath>
#include <filesystem>

#include "io/images/files.h"
#include "io/rasters/gdal.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

using tools::Raster;

class TerrainCommand : public CommandTest {
 protected:
  // A ridge and a hill, 20x16 cells, as an ASCII grid; `header` replaces lines of it.
  std::string grid(const std::string& nodata = "NODATA_value -9999\n", int hole = -9999) {
    std::ostringstream text;
    text << "ncols 20\nnrows 16\nxllcorner 1000\nyllcorner 2000\ncellsize 10\n" << nodata;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 20; ++x) {
        if (x == 3 && y == 4) {
          text << hole << ' ';
        } else {
          text << 100 + 30 * std::exp(-0.1 * ((x - 12) * (x - 12) + (y - 5) * (y - 5))) + y << ' ';
        }
      }
      text << '\n';
    }
    return text.str();
  }
  // A VRT over grid.asc: elements of the data set, and of its band.
  std::string vrt(const std::string& dataset, const std::string& band = "",
                  const std::string& source = "grid.asc", const std::string& type = "Float32") {
    return "<VRTDataset rasterXSize=\"20\" rasterYSize=\"16\">" + dataset +
           "<VRTRasterBand dataType=\"" + type + "\" band=\"1\">" + band +
           "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + source +
           "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></"
           "VRTDataset>";
  }
  std::vector<float> svf_of(const std::string& file, const std::string& more = "") {
    expect_success("terrain " + file + " -o result.pfm -q " + more);
    tools::Image image;
    EXPECT_TRUE(tools::read_image(path("result.pfm"), &image).ok());
    return image.channels.empty() ? std::vector<float>() : image.channels[0].values;
  }
  static constexpr const char* kPlace = "<GeoTransform>1000, 10, 0, 2160, 0, -10</GeoTransform>";
};

bool same(const std::vector<float>& a, const std::vector<float>& b, float within = 1e-6f) {
  if (a.size() != b.size() || a.empty()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i]) || std::fabs(a[i] - b[i]) > within) return false;
  }
  return true;
}

TEST_F(TerrainCommand, WritesEveryFormat) {
  tools::Image heights(30, 20);
  auto& z = heights.add("Y");
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = float(i % 7) + float(i / 90);
  ASSERT_TRUE(tools::write_image(path("in.pfm"), heights).ok());
  const std::vector<float> svf = svf_of("in.pfm", "--cell-size 2");
  for (const char* out : {"out.exr", "out.npy"}) {
    const std::string line = "terrain in.pfm --cell-size 2 -q --quantity svf,openness,horizon -o ";
    expect_success(line + out);
  }
  tools::Image exr;
  ASSERT_TRUE(tools::read_image(path("out.exr"), &exr).ok());
  EXPECT_EQ(exr.channels.size(), 18u);
  EXPECT_TRUE(same(exr.find("svf")->values, svf));
  EXPECT_NE(exr.find("horizon.022.500"), nullptr);
  EXPECT_NE(read_file(path("out.npy")).find("(18, 20, 30)"), std::string::npos);
  expect_success("terrain in.pfm --cell-size 2 -q -o out.png --picture shade.png --json out.json");
  tools::Image png, shade;
  ASSERT_TRUE(tools::read_image(path("out.png"), &png).ok());
  EXPECT_TRUE(same(png.channels[0].values, svf, 1e-5f));
  ASSERT_TRUE(tools::read_image(path("shade.png"), &shade).ok());
  EXPECT_EQ(shade.channels.size(), 3u);
  EXPECT_NE(read_file(path("out.json")).find("time to compute"), std::string::npos);
}

TEST_F(TerrainCommand, SaysWhatIsWrong) {
  tools::Image heights(30, 20);
  heights.add("Y")[7] = -9999;
  ASSERT_TRUE(tools::write_image(path("in.pfm"), heights).ok());
  const std::string line = "terrain in.pfm --cell-size 2 ";
  expect_failure("terrain in.pfm -o x.pfm", 2, "how large its cells are; give --cell-size");
  expect_failure(line + "-o x.pfm", 2,
                 "give --nodata -9999 or, if they are heights, --nodata none");
  expect_failure(line + "--nodata -9999", 2, "nothing to write");
  expect_failure(line + "--nodata few -o x.pfm", 2, "--nodata is 'few'");
  expect_failure(line + "-o x.pfm --quantity svf,sky", 2, "--quantity names 'sky'");
  expect_failure(line + "-o x.pfm --quantity svf,svf", 2, "'svf' twice");
  expect_failure(line + "-o x.pfm --quantity svf,openness", 2, "can hold one result");
  expect_failure(line + "-o x.png --quantity openness", 2, "holds shares in [0, 1]");
  expect_failure(line + "-o x.jpg", 2, "must end in .tif");
  expect_failure(line + "-o x.pfm --picture x.jpg", 2, "--picture is 'x.jpg'");
  expect_failure(line + "-o x.pfm --radius far", 2, "--radius is 'far'");
  expect_failure(line + "-o x.pfm --radius infpx", 2, "--radius is 'infpx'");
  expect_failure(line + "-o x.pfm --radius 1 --nodata none", 2, "radius is 1; it must reach");
  expect_failure(line + "-o x.pfm --refraction 0.13", 2, "--refraction needs --curvature");
  expect_failure(line + "-o x.pfm --azimuths 0", 2, "--azimuths is '0'");
  expect_failure(line + "-o x.pfm --band 2", 2, "channels 1 to 1");
  EXPECT_FALSE(std::filesystem::exists(path("x.pfm")));
  expect_success(line + "-o x.pfm --nodata none -q");
  expect_success(line + "-o x.pfm --nodata -9999 --radius 10px -q");
}

TEST_F(TerrainCommand, PresetsGiveDefaults) {
  tools::Image heights(60, 50);
  auto& z = heights.add("Y");
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = float(i % 11) + float(i / 240);
  ASSERT_TRUE(tools::write_image(path("in.pfm"), heights).ok());
  auto result = [&](const std::string& more) {
    expect_success("terrain in.pfm --cell-size 2 -q -o out.exr " + more);
    tools::Image image;
    EXPECT_TRUE(tools::read_image(path("out.exr"), &image).ok());
    return image;
  };
  const tools::Image a = result("--preset archaeology");
  EXPECT_EQ(a.channels.size(), 5u);
  const tools::Image b =
      result("--quantity svf,asvf --radius 20 --azimuths 16 --asvf-direction 45");
  EXPECT_TRUE(same(a.find("asvf")->values, b.find("asvf")->values));
  EXPECT_TRUE(same(a.find("svf")->values, b.find("svf")->values));
  EXPECT_EQ(result("--preset solar").channels.size(), 73u);
  EXPECT_EQ(result("--preset solar --azimuths 8 --quantity horizon").channels.size(), 8u);
  EXPECT_NE(result("--preset climate").find("visible-sky"), nullptr);
  EXPECT_NE(result("--preset city").find("svf-cosine"), nullptr);
  expect_failure("terrain in.pfm --cell-size 2 -o x.exr --preset war", 2, "--preset is 'war'");
}

TEST_F(TerrainCommand, ReadsRastersWithTheirNodata) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write("grid.asc", grid());
  const std::vector<float> svf = svf_of("grid.asc");
  ASSERT_EQ(svf.size(), 320u);
  EXPECT_TRUE(std::isnan(svf[4 * 20 + 3]));
  EXPECT_EQ(std::count_if(svf.begin(), svf.end(), [](float v) { return std::isnan(v); }), 1);
  // The same hole in other spellings.
  write("grid.asc", grid("", -9999));
  expect_failure("terrain grid.asc -o x.pfm", 2, "give --nodata -9999");
  EXPECT_TRUE(same(svf_of("grid.asc", "--nodata -9999"), svf));
  for (const char* value : {"-9999", "nan", "-3.4028234663852886e+38", "3.4028234663852886e+38"}) {
    std::string text = grid("", -9999);
    text.replace(text.find("-9999"), 5, value);
    write("grid.asc", text);
    write("in.vrt", vrt(kPlace, std::string("<NoDataValue>") + value + "</NoDataValue>"));
    EXPECT_TRUE(same(svf_of("in.vrt"), svf)) << value;
    // Numbers that are no heights have no data whatever the file says.
    if (std::string(value) != "-9999") {
      write("in.vrt", vrt(kPlace));
      EXPECT_TRUE(same(svf_of("in.vrt"), svf)) << value;
    }
  }
  // A mask.
  write("grid.asc", grid("", 0));
  std::ostringstream ones;
  ones << "ncols 20\nnrows 16\nxllcorner 1000\nyllcorner 2000\ncellsize 10\n";
  for (int i = 0; i < 320; ++i) ones << (i == 4 * 20 + 3 ? 0 : 255) << ' ';
  write("mask.asc", ones.str());
  write("in.vrt", vrt(std::string(kPlace) +
                      "<MaskBand><VRTRasterBand dataType=\"Byte\"><SimpleSource><SourceFilename "
                      "relativeToVRT=\"1\">mask.asc</SourceFilename><SourceBand>1</SourceBand>"
                      "</SimpleSource></VRTRasterBand></MaskBand>"));
  EXPECT_TRUE(same(svf_of("in.vrt"), svf));
}

TEST_F(TerrainCommand, ReadsUnitsScalesAndRowsFromTheSouth) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write("grid.asc", grid());
  const std::string hole = "<NoDataValue>-9999</NoDataValue>";
  const std::vector<float> svf = svf_of("grid.asc");
  write("in.vrt", vrt("<GeoTransform>1000, 10, 0, 2000, 0, 10</GeoTransform>", hole));
  std::vector<float> turned = svf_of("in.vrt");
  ASSERT_EQ(turned.size(), svf.size());
  // The grid's first row is now the southern one: a mirrored landscape.
  EXPECT_TRUE(std::isnan(turned[11 * 20 + 3]));
  // Heights in feet, and as scaled integers.
  write("in.vrt", vrt(kPlace, hole + "<UnitType>ft</UnitType>"));
  const std::vector<float> feet = svf_of("in.vrt");
  EXPECT_TRUE(same(feet, svf_of("grid.asc", "--z-factor 0.3048")));
  EXPECT_FALSE(same(feet, svf, 1e-3f));
  EXPECT_TRUE(same(svf_of("in.vrt", "--z-factor 1"), svf));
  write("in.vrt", vrt(kPlace, hole + "<Offset>50</Offset><Scale>0.3048</Scale>"));
  EXPECT_TRUE(same(svf_of("in.vrt"), feet, 1e-5f));
  write("in.vrt", vrt(kPlace, hole + "<UnitType>ell</UnitType>"));
  expect_failure("terrain in.vrt -o x.pfm", 3, "its heights are in 'ell'");
  write("in.vrt", vrt(std::string(kPlace) + "<SRS>EPSG:2225</SRS>", hole));
  expect_failure("terrain in.vrt -o x.pfm", 3, "does not say in what its heights are");
  // Slopes are the same but for rounding, which chooses among points of a plane.
  EXPECT_TRUE(same(svf_of("in.vrt", "--z-factor 0.3048006"), svf, 2e-3f));
  // Degrees.
  write("in.vrt", vrt("<GeoTransform>10, 0.0001, 0, 60, 0, -0.0001</GeoTransform><SRS>EPSG:4326"
                      "</SRS>",
                      hole));
  const CommandResult r = run("terrain in.vrt -o x.pfm");
  EXPECT_NE(r.out.find("cells of 5.58014 x 11.1412 m"), std::string::npos) << r.out;
}

TEST_F(TerrainCommand, KeepsWhereARasterLies) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write("grid.asc", grid());
  const std::string hole = "<NoDataValue>-9999</NoDataValue>";
  for (const char* transform : {"10, 0.0001, 0, 60, 0, -0.0001", "10, 0.0001, 0, 60, 0, 0.0001"}) {
    write("in.vrt", vrt("<GeoTransform>" + std::string(transform) +
                            "</GeoTransform><SRS>EPSG:4326</SRS><Metadata><MDI key=\"WHO\">me"
                            "</MDI></Metadata>",
                        hole));
    expect_success("terrain in.vrt -o out.tif --quantity svf,openness --overviews -q");
    Raster in, out;
    ASSERT_TRUE(tools::read_raster(path("in.vrt"), {}, &in).ok());
    tools::RasterOptions first;
    first.band = 1;
    ASSERT_TRUE(tools::read_raster(path("out.tif"), first, &out).ok());
    EXPECT_EQ(in.row_widths, out.row_widths);
    EXPECT_EQ(in.cell_height, out.cell_height);
    EXPECT_TRUE(same(out.heights, svf_of("in.vrt")));
    const std::string bytes = read_file(path("out.tif"));
    for (const char* part : {"WHO", "-9999", "quantity=svf,openness preset=none azimuths=16"}) {
      EXPECT_NE(bytes.find(part), std::string::npos) << part;
    }
  }
}

TEST_F(TerrainCommand, RefusesRastersThatLie) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write("grid.asc", grid());
  auto refuse = [&](const std::string& text, int code, const std::string& part) {
    write("in.vrt", text);
    expect_failure("terrain in.vrt -o x.tif", code, part);
    EXPECT_FALSE(std::filesystem::exists(path("x.tif")));
  };
  refuse(vrt("<GeoTransform>0, 10, 1, 0, 1, -10</GeoTransform>"), 3, "is rotated");
  refuse(vrt("<GeoTransform>0, -10, 0, 0, 0, -10</GeoTransform>"), 3, "from west to east");
  refuse(vrt("", "<NoDataValue>-9999</NoDataValue>"), 2, "how large its cells are");
  refuse(vrt("<GeoTransform>0, 1, 0, 91, 0, -1</GeoTransform><SRS>EPSG:4326</SRS>"), 3,
         "project it first");
  refuse(vrt(kPlace, "", "grid.asc", "CFloat32"), 3, "complex numbers");
  refuse(vrt(kPlace, "", "absent.asc"), 3, "in.vrt");
  refuse(vrt(kPlace, "", "/vsicurl/http://127.0.0.1:9/x.tif"), 2, "lies in a network");
  refuse("<VRTDataset rasterXSize=\"0\" rasterYSize=\"5\"></VRTDataset>", 3, "not a raster");
  refuse("<VRTDataset rasterXSize=\"900000\" rasterYSize=\"900000\">" + std::string(kPlace) +
             "<VRTRasterBand dataType=\"Float32\" band=\"1\"></VRTRasterBand></VRTDataset>",
         3, "more than this machine has");
  refuse("no raster at all", 3, "not a raster that GDAL can read");
  expect_failure("terrain absent.tif -o x.tif", 3, "No such file");
  expect_failure("terrain /vsicurl/http://127.0.0.1:9/x.tif -o x.tif", 2, "lies in a network");
  expect_failure("terrain http://127.0.0.1:9/x.tif -o x.tif", 2, "lies in a network");
  expect_failure("terrain WMS:http://127.0.0.1:9/x -o x.tif", 2, "lies in a network");

  // Damaged files.
  expect_success("terrain grid.asc -o good.tif -q");
  const std::string good = read_file(path("good.tif"));
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, good.size() / 2}) {
    write("cut.tif", good.substr(0, size));
    expect_failure("terrain cut.tif -o x.tif", 3, "cut.tif");
  }
  // Bands: one must be chosen.
  expect_success("terrain grid.asc -o two.tif -q --quantity svf,openness");
  expect_failure("terrain two.tif -o x.tif", 2, "has 2 bands");
  expect_failure("terrain two.tif --band 3 -o x.tif", 2, "bands 1 to 2");
  EXPECT_FALSE(std::filesystem::exists(path("x.tif")));
}

TEST_F(TerrainCommand, ComputesInTilesAndParts) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  std::ostringstream text;
  text << "ncols 150\nnrows 140\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n";
  for (int i = 0; i < 150 * 140; ++i) {
    const int x = i % 150, y = i / 150;
    text << 100 + 40 * std::sin(x * 0.21 + y * 0.13) + 25 * std::cos(y * 0.37)
         << (x < 149 ? ' ' : '\n');
  }
  write("grid.asc", text.str());
  auto result = [&](const std::string& file) {
    Raster raster;
    tools::RasterOptions first;
    first.band = 1;
    EXPECT_TRUE(tools::read_raster(path(file), first, &raster).ok());
    return raster.heights;
  };
  const std::string line = "terrain grid.asc -q --quantity svf,openness --azimuths 8 -o ";
  expect_success(line + "whole.tif");
  expect_success(line + "tiles.tif --tile 64");
  // The halo reaches the border everywhere here.
  EXPECT_TRUE(same(result("tiles.tif"), result("whole.tif"), 1e-4f));
  EXPECT_FALSE(std::filesystem::exists(path("tiles.tif.tiles")));
  // Parts, in any order, one of them taken up again; the last one writes.
  expect_success(line + "parts.tif --tile 64 --part 2/2");
  EXPECT_FALSE(std::filesystem::exists(path("parts.tif")));
  EXPECT_TRUE(std::filesystem::exists(path("parts.tif.tiles/tile-1.npy")));
  std::filesystem::remove(path("parts.tif.tiles/tile-3.npy"));
  expect_success(line + "parts.tif --tile 64 --part 2/2");
  expect_failure(line + "parts.tif --tile 128", 2, "holds parts of another run");
  expect_success(line + "parts.tif --tile 64 --part 1/2");
  EXPECT_EQ(read_file(path("parts.tif")).size(), read_file(path("tiles.tif")).size());
  EXPECT_TRUE(same(result("parts.tif"), result("tiles.tif"), 0));
  for (const char* radius : {" --radius 8px", " --radius 40px"}) {
    expect_success(line + "whole.tif" + radius);
    expect_success(line + "tiles.tif --tile 64" + radius);
    EXPECT_TRUE(same(result("tiles.tif"), result("whole.tif"), 0)) << radius;
  }
  expect_failure(line + "x.tif --memory 3", 2, "--memory is '3'");
  expect_failure(line + "x.tif --memory 0.1M", 2, "do not hold a band of rows");
  expect_failure(line + "x.tif --part 3/2", 2, "--part is '3/2'");
  expect_failure(line + "x.exr --tile 64", 2, "--output as .tif");
  EXPECT_FALSE(std::filesystem::exists(path("x.tif.tiles")));
}

TEST_F(TerrainCommand, WritesWholeFilesOrNone) {
  if (!tools::has_gdal()) GTEST_SKIP() << "this build has no GDAL";
  write("grid.asc", grid());
  const std::string line = "terrain grid.asc -o out.tif --quantity horizon,svf --azimuths 64";
  expect_failure(line, 1, "cannot write out.tif", "ulimit -f 8;");
  EXPECT_FALSE(std::filesystem::exists(path("out.tif")));
  expect_failure("terrain grid.asc -o absent/out.tif", 1, "there is no folder absent");
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(name.find("out.tif"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace obscura
