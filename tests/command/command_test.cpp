// The command as a user runs it: its results, and its messages for mistakes.
#include <cmath>
#include <cstring>
#include <vector>

#include "io/images/files.h"
#include "nlohmann/json.hpp"
#include "paths.h"
#include "scene/truth/compare.h"
#include "tests/command/run_command.h"

namespace obscura {
namespace {

using tools::Image;

std::string pfm(int width, int height, const std::vector<float>& values) {
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
  return bytes;
}

TEST_F(CommandTest, SceneGBufferAndFileGiveTheSamePicture) {
  expect_success("gbuffer 'scene:hall?size=160x90' -o g.exr");
  expect_success("ao g.exr --method line --radius 1 -o from-file.exr");
  expect_success("ao 'scene:hall?size=160x90' --method line --radius 1 -o from-scene.exr");
  Image a, b;
  ASSERT_TRUE(tools::read_image(path("from-file.exr"), &a).ok());
  ASSERT_TRUE(tools::read_image(path("from-scene.exr"), &b).ok());
  EXPECT_EQ(a.width, 160);
  EXPECT_EQ(a.height, 90);
  tools::Comparison c;
  ASSERT_TRUE(tools::compare(a.view(0), b.view(0), {}, &c).ok());
  EXPECT_LT(c.e_a, 0.01);  // the camera passes through single-precision matrices
  EXPECT_GT(c.correlation, 0.9999);
}

TEST_F(CommandTest, SimdTargetsAreListedLimitedAndReported) {
  const CommandResult all = run("info --simd");
  ASSERT_EQ(all.code, 0) << all.err;
  const std::string slowest = all.out.substr(0, all.out.find('\n'));
  const CommandResult limited =
      run("ao 'scene:bump?size=32x18' --method line -o v.pfm --json -", "OBSCURA_SIMD=" + slowest);
  ASSERT_EQ(limited.code, 0) << limited.err;
  const auto machine = nlohmann::json::parse(limited.out)["machine"];
  EXPECT_EQ(machine["simd_limit"], slowest);
  EXPECT_EQ(machine["simd_targets"][0], slowest);
  expect_failure("info --simd", 2,
                 "the SIMD target is 'abacus'; this processor and build have " + slowest,
                 "OBSCURA_SIMD=abacus");
}

TEST_F(CommandTest, BackDepthAndLayersPassThroughAFile) {
  expect_success("gbuffer 'scene:tower?size=64x36&layers=2&back-depth=1' -o g.exr");
  for (const std::string occluder : {"back-depth", "layers:2"}) {
    const std::string method = " --method ray-traced --rays 16 --occluder " + occluder;
    expect_success("ao g.exr" + method + " -o a.pfm");
    expect_success("ao 'scene:tower?size=64x36'" + method + " -o b.pfm");
    Image a, b;
    ASSERT_TRUE(tools::read_image(path("a.pfm"), &a).ok());
    ASSERT_TRUE(tools::read_image(path("b.pfm"), &b).ok());
    tools::Comparison c;
    ASSERT_TRUE(tools::compare(a.view(0), b.view(0), {}, &c).ok());
    EXPECT_LT(c.e_a, 0.2) << occluder;  // the camera passes through single-precision matrices
  }
  expect_failure("ao g.exr --method ray-traced --occluder layers:3 -o x.pfm", 3, "layers");
}

// What `auto` finds depends on the file; a result says it, and compare says where two differ.
TEST_F(CommandTest, ResultsSayWhichOccluderTheyWereMadeWith) {
  expect_success("gbuffer 'scene:tower?size=64x36' -o depth.exr");
  expect_success("gbuffer 'scene:tower?size=64x36&back-depth=1' -o back.exr");
  expect_success("gbuffer 'scene:tower?size=64x36&layers=2' -o layers.exr");
  const std::string far_field = " --method far-field --preset fast --occluder ";
  const std::string rays = " --method ray-traced --rays 16 --occluder ";
  const struct {
    std::string arguments, occluder;
  } cases[] = {{"depth.exr" + far_field + "solid", "solid"},
               {"depth.exr" + far_field + "auto", "auto, from widths"},
               {"back.exr" + far_field + "auto", "auto, from back depth"},
               {"layers.exr" + far_field + "auto", "auto, from back depth"},
               {"layers.exr" + rays + "auto", "auto, from layers"},
               {"depth.exr" + rays + "thickness:0.5", "thickness:0.5"}};
  for (const auto& c : cases) {
    expect_success("ao " + c.arguments + " -o x.exr");
    Image x;
    ASSERT_TRUE(tools::read_image(path("x.exr"), &x).ok());
    EXPECT_EQ(x.occluder, c.occluder) << c.arguments;
  }
  expect_success("ao depth.exr" + far_field + "solid -o a.exr");
  const CommandResult different = run("compare a.exr x.exr");
  EXPECT_EQ(different.code, 0);
  EXPECT_NE(different.err.find("the image's occluder is solid, the reference's thickness:0.5"),
            std::string::npos);
  EXPECT_EQ(run("compare a.exr a.exr").err, "");
}

TEST_F(CommandTest, AnyThreadCountGivesTheSameBytes) {
  expect_success("ao 'scene:meadow?size=96x54' --method line --threads 1 -o a.pfm");
  expect_success("ao 'scene:meadow?size=96x54' --method line --threads 3 -o b.pfm");
  EXPECT_EQ(read_file(path("a.pfm")), read_file(path("b.pfm")));
}

TEST_F(CommandTest, EveryFormatHoldsTheResult) {
  for (const char* name : {"v.exr", "v.pfm", "v.png"}) {
    expect_success(std::string("ao 'scene:cornell?size=64x64' --method line -o ") + name);
    Image image;
    ASSERT_TRUE(tools::read_image(path(name), &image).ok()) << name;
    EXPECT_EQ(image.width, 64);
    EXPECT_EQ(image.channels.size(), 1u);
  }
}

TEST_F(CommandTest, KeepChannelsPassesTheOthersThrough) {
  expect_success("gbuffer 'scene:bump?size=32x32' -o g.exr");
  expect_success("ao g.exr --method line --keep-channels -o out.exr");
  Image image;
  ASSERT_TRUE(tools::read_image(path("out.exr"), &image).ok());
  for (const char* channel : {"visibility", "Z", "N.X", "N.Y", "N.Z"}) {
    EXPECT_NE(image.find(channel), nullptr) << channel;
  }
  EXPECT_EQ(image.width, 32);
  // Attributes too: the result still knows its camera.
  expect_success("ao out.exr --method line -o again.exr");
}

TEST_F(CommandTest, JsonHasTheOneShape) {
  const CommandResult r =
      run("ao 'scene:plane?size=16x16' --method line -o v.pfm --json - --seed 7");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  for (const char* key : {"rows", "machine", "settings"}) EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"name", "metric", "value", "unit"}) {
    EXPECT_TRUE(json["rows"][0].contains(key)) << key;
  }
  EXPECT_EQ(json["settings"]["seed"], 7);
}

TEST_F(CommandTest, CompareReportsAKnownDifference) {
  write("a.pfm", pfm(2, 2, {0.5f, 0.5f, 0.5f, 0.5f}));
  write("b.pfm", pfm(2, 2, {0.5f, 0.5f, 0.5f, 0.9f}));
  const CommandResult r = run("compare a.pfm b.pfm --json - --error-image e.png");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["rows"][0]["metric"], "e_A");
  EXPECT_NEAR(json["rows"][0]["value"].get<double>(), 10, 1e-4);
  Image e;
  ASSERT_TRUE(tools::read_image(path("e.png"), &e).ok());
  EXPECT_EQ(e.view(0)(0, 0), 1);
  EXPECT_EQ(e.view(0)(1, 0), 0);  // PFM's last row is the top one
}

// Figures of the other pixels are printed, but a script that looks at the exit code is warned.
TEST_F(CommandTest, CompareNeverTakesNanForEqual) {
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  write("a.pfm", pfm(2, 2, {0.5f, nan, nan, inf}));
  write("b.pfm", pfm(2, 2, {0.5f, 0.5f, nan, inf}));
  write("nan.pfm", pfm(2, 2, {nan, nan, nan, nan}));
  const std::string counts = "2 of 4 pixels are NaN (in the first image 2, in the second 1)";
  expect_failure("compare a.pfm b.pfm", 3, counts);
  expect_failure("compare a.pfm a.pfm", 3, "2 of 4 pixels are NaN");
  expect_failure("compare nan.pfm nan.pfm", 3, "4 are NaN");
  const CommandResult r = run("compare a.pfm b.pfm --json c.json");
  EXPECT_NE(r.out.find("e_A 0.000 %"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("(2 pixels)"), std::string::npos) << r.out;
  EXPECT_NE(read_file(path("c.json")).find("\"NaN\""), std::string::npos);
  const CommandResult allowed = run("compare a.pfm b.pfm --allow-nan");
  EXPECT_EQ(allowed.code, 0);
  EXPECT_NE(allowed.err.find(counts + ", left out"), std::string::npos) << allowed.err;
  expect_failure("compare nan.pfm nan.pfm --allow-nan", 3, "4 are NaN");
  // Left out by name, it is nobody's concern.
  write("mask.pfm", pfm(2, 2, {1, inf, inf, 1}));
  EXPECT_EQ(run("compare a.pfm b.pfm --mask mask.pfm").code, 0);
}

TEST_F(CommandTest, DepthKindsAndCamerasFromFlags) {
  std::vector<float> depth(64 * 48, 2.0f), ndc(64 * 48);
  for (float& v : ndc) v = 10 * (2 - 1) / (2 * (10.0f - 1));  // near 1, far 10
  write("d.pfm", pfm(64, 48, depth));
  write("n.pfm", pfm(64, 48, ndc));
  write("p.txt", "1.5 0 0 0  0 2 0 0  0 0 -1.1111111 -1.1111111  0 0 -1 0");
  expect_success("ao d.pfm --method line --fov-y 50 -o a.pfm");
  expect_success("ao d.pfm --method line --focal-length 35 --sensor-height 24 -o b.pfm");
  expect_success("ao d.pfm --method line --ortho-height 3 -o c.pfm");
  expect_success("ao d.pfm --method line --projection p.txt -o e.pfm");
  expect_success("ao n.pfm --method line --depth-kind ndc --near 1 --far 10 --fov-y 50 -o f.pfm");
  expect_success("ao n.pfm --method line --depth-kind ndc --projection p.txt -o g.pfm");
  expect_success("ao d.pfm --method line --fov-y 50 --guard-band 8,4 -o h.pfm");
  for (const char* name : {"a.pfm", "b.pfm", "c.pfm", "e.pfm", "f.pfm", "g.pfm", "h.pfm"}) {
    Image v;
    ASSERT_TRUE(tools::read_image(path(name), &v).ok());
    EXPECT_EQ(v.width, name[0] == 'h' ? 48 : 64);
    for (float x : v.channels[0].values) EXPECT_NEAR(x, 1, 1e-3) << name;
  }
}

TEST_F(CommandTest, UsageMistakesAreNamed) {
  expect_failure("frobnicate", 2, "there is no command 'frobnicate'");
  expect_failure("", 2, "the commands are ao");
  expect_failure("ao scene:hall", 2, "--output");
  expect_failure("ao scene:hall -o x.exr --unknown 1", 2, "--unknown");
  expect_failure("ao scene:hall -o x.exr --method best", 2, "--method is 'best'");
  expect_failure("ao scene:hall -o x.exr --method line --radius 0", 2, "--radius is '0'");
  expect_failure("ao scene:hall -o x.exr --method line --radius -1", 2, "(0, inf]");
  expect_failure("ao scene:hall -o x.exr --method line --samples 1000000", 2, "[1, 32]");
  expect_failure("ao scene:hall -o x.exr --method line --falloff linear", 2, "constant, exp");
  expect_failure("ao scene:hall -o x.exr --method line --occluder thickness:-1", 2, "thickness:T");
  expect_failure("ao scene:hall -o x.exr --threads 5000", 2, "threads");
  expect_failure("ao scene:hall -o x.exr --outputs depth", 2, "--outputs names 'depth'");
  expect_failure("ao scene:hall -o x.exr --method line --outputs bent-normal", 2, "bent-normal");
  expect_failure("ao scene:hall -o x.png --outputs visibility,cone-angle", 2, "one result");
  expect_failure("ao scene:hall -o x.jpg", 2, ".exr, .pfm or .png");
  expect_failure("ao scene:hull -o x.exr", 2, "hull");
  expect_failure("ao 'scene:hall?colour=red' -o x.exr", 2, "colour");
  for (const char* method : {"far-field", "ray-traced", "hemisphere", "mipmap"}) {
    expect_failure(
        std::string("ao 'scene:plane?size=16x16' --normals none -o x.exr --method ") + method, 2,
        "needs them");
  }
  expect_failure("ao scene:hall --near 1 -o x.exr", 2, "--near does not apply");
  expect_failure("ao scene:hall --keep-channels -o x.exr", 2, "--keep-channels");
  write("d.pfm", pfm(4, 4, std::vector<float>(16, 1.0f)));
  expect_failure("ao d.pfm -o x.exr", 2, "fov-y");
  expect_failure("ao d.pfm --fov-y 200 -o x.exr", 2, "fov-y");
  expect_failure("ao d.pfm --fov-y 50 --ortho-height 1 -o x.exr", 2, "exclude each other");
  expect_failure("ao d.pfm --fov-y 50 --depth-kind ndc -o x.exr", 2, "near");
  expect_failure("ao d.pfm --fov-y 50 --method geometric -o x.exr", 2, "geometric needs a scene");
  expect_failure("gbuffer d.pfm --fov-y 50 -o x.exr", 2, "depth image already");
}

TEST_F(CommandTest, InputMistakesAreNamed) {
  expect_failure("ao missing.exr -o x.exr", 3, "missing.exr: No such file");
  expect_failure("ao . -o x.exr", 3, "ending");
  write("empty.exr", "");
  expect_failure("ao empty.exr -o x.exr", 3, "empty.exr");
  write("noise.exr", std::string(5000, 'x'));
  expect_failure("ao noise.exr -o x.exr", 3, "noise.exr");
  write("noise.pfm", "hello, world");
  expect_failure("ao noise.pfm --fov-y 50 -o x.exr", 3, "noise.pfm");
  write("short.pfm", pfm(8, 8, {1, 2, 3}));
  expect_failure("ao short.pfm --fov-y 50 -o x.exr", 3, "truncated");
  write("zero.pfm", pfm(0, 0, {}));
  expect_failure("ao zero.pfm --fov-y 50 -o x.exr", 3, "0x0");
  write("negative.pfm", pfm(3, 1, {1, -1, -2}));
  expect_failure("ao negative.pfm --fov-y 50 -o x.exr", 3, "pixel (1, 0) is -1");
  write("noise.png", "\x89PNG\r\n\x1a\n rubbish");
  expect_failure("ao noise.png --near 1 --far 2 --fov-y 50 -o x.exr", 3, "noise.png");
  write("p.txt", "1 2 3");
  write("d.pfm", pfm(4, 4, std::vector<float>(16, 1.0f)));
  expect_failure("ao d.pfm --projection p.txt -o x.exr", 3, "16 numbers");
  expect_failure("ao d.pfm --fov-y 50 --guard-band 3 -o x.exr", 3, "guard band");
  expect_success("gbuffer 'scene:plane?size=64x64' -o g.exr");
  expect_failure("ao g.exr --depth-channel depth -o x.exr", 3, "it has N.X, N.Y, N.Z, Z");
  expect_failure("ao g.exr --normals Normal -o x.exr", 3, "Normal.X");
  const std::string whole = read_file(path("g.exr"));
  write("cut.exr", whole.substr(0, whole.size() / 2));
  expect_failure("ao cut.exr -o x.exr", 3, "cut.exr");
  expect_success("ao g.exr --method line -o v.pfm");
  expect_failure("compare d.pfm v.pfm", 3, "4x4 and 64x64");
  EXPECT_FALSE(std::filesystem::exists(path("x.exr")));
}

TEST_F(CommandTest, FailingToWriteLeavesNoHalfFileAndKeepsTheOldOne) {
  write("file", "in the way");
  expect_failure("ao 'scene:plane?size=64x64' --method line -o file/x.exr", 1, "file/x.exr");
  for (const char* name : {"v.exr", "v.pfm", "v.png"}) {
    write(name, "old");
    // A limit of one or two blocks stands for a full disk.
    expect_failure(std::string("ao 'scene:hall?size=256x256' --method line -q -o ") + name, 1, name,
                   "ulimit -f 2;");
    EXPECT_EQ(read_file(path(name)), "old");
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().filename().string().find("v.exr."), std::string::npos);
  }
}

TEST_F(CommandTest, TinyAndOddImages) {
  for (auto [w, h] : {std::pair{1, 1}, {1, 7}, {7, 1}, {3, 5}, {17, 33}}) {
    write("d.pfm", pfm(w, h, std::vector<float>(w * h, 1.0f)));
    expect_success("ao d.pfm --fov-y 50 --method line -o v.pfm");
    Image v;
    ASSERT_TRUE(tools::read_image(path("v.pfm"), &v).ok());
    for (float x : v.channels[0].values) EXPECT_NEAR(x, 1, 1e-3);
  }
}

TEST_F(CommandTest, BackgroundIsOpen) {
  write("d.pfm", pfm(4, 1, {INFINITY, NAN, 100, 1}));
  expect_success("ao d.pfm --fov-y 50 --far 100 --method line -o v.pfm");
  Image v;
  ASSERT_TRUE(tools::read_image(path("v.pfm"), &v).ok());
  for (int x = 0; x < 3; ++x) EXPECT_EQ(v.view(0)(x, 0), 1);
}

TEST_F(CommandTest, InfoDescribesAFile) {
  expect_success("gbuffer 'scene:plane?size=20x10&guard-band=2' -o g.exr");
  const CommandResult r = run("info g.exr --json -");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["settings"]["width"], 24);
  EXPECT_EQ(json["settings"]["depth"], "Z");
  expect_failure("info missing.pfm", 3, "missing.pfm");
}

TEST_F(CommandTest, DemoWritesItsPictures) {
  expect_success("demo -q --size 96x54 -o pictures");
  for (const char* name : {"hall-visibility.png", "meadow-visibility.png"}) {
    Image image;
    EXPECT_TRUE(tools::read_image(path(std::string("pictures/") + name), &image).ok()) << name;
  }
}

TEST_F(CommandTest, SettingsPageIsUpToDate) {
  const CommandResult r = run("settings");
  ASSERT_EQ(r.code, 0);
  EXPECT_EQ(r.out, read_file(OBSCURA_SOURCE_DIR "/docs/settings.md"))
      << "make it again: build/release/bin/obscura settings > docs/settings.md";
}

TEST_F(CommandTest, EveryCommandHasHelp) {
  for (const char* name : {"ao", "gbuffer", "compare", "info", "demo", "bench", "settings"}) {
    const CommandResult r = run(std::string(name) + " --help");
    EXPECT_EQ(r.code, 0);
    EXPECT_GT(r.out.size(), 100u) << name;
  }
}

}  // namespace
}  // namespace obscura
