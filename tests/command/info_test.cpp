#include "tests/command/run_command.h"

namespace obscura {
namespace {

class InfoTest : public CommandTest {
 protected:
  // Whether each line is among those that `info` prints.
  void expect_lines(const std::string& input, const std::vector<std::string>& lines) {
    const CommandResult r = run("info " + input);
    EXPECT_EQ(r.code, 0) << r.err;
    for (const std::string& line : lines) {
      EXPECT_NE(("\n" + r.out).find("\n" + line + "\n"), std::string::npos) << line << r.out;
    }
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(path(name), std::ios::binary) << text;
  }
};

// A face of extent 2 x 1 x 4 far from the origin: where it is, and how it is read.
TEST_F(InfoTest, Meshes) {
  write("m.obj",
        "v 448000 5 5411000\nv 448002 5 5411000\nv 448002 6 5411000\nv 448000 6 5411004\n"
        "f 1 2 3 4\n");
  expect_lines("m.obj",
               {"kind: mesh", "triangles: 2", "vertices: 4", "min: [448000.0,5.0,5411000.0]",
                "max: [448002.0,6.0,5411004.0]", "size: 4.0", "picture: obscura ao m.obj -o ao.png",
                "at its vertices: obscura bake m.obj -o baked.ply"});
  const CommandResult json = run("info m.obj --json -");
  EXPECT_EQ(json.code, 0);
  EXPECT_NE(json.out.find("\"triangles\": 2"), std::string::npos);
  expect_failure("info none.obj", 3, "none.obj");
  // A mesh without extent still has numbers.
  write("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  const CommandResult point = run("info point.obj");
  EXPECT_EQ(point.out.find("nan"), std::string::npos) << point.out;
  EXPECT_EQ(point.out.find("null"), std::string::npos) << point.out;
}

TEST_F(InfoTest, Scenes) {
  expect_lines("'scene:plane?size=64x48'",
               {"kind: procedural scene", "triangles: 12", "size: 100.0", "picture_size: [64,48]",
                "picture: obscura ao 'scene:plane?size=64x48' -o ao.png"});
  expect_failure("info scene:nowhere", 2, "hall");
  expect_failure("info 'scene:plane?colour=red'", 2, "colour");
}

// fov-y 90 degrees, twice as wide as high: m00 = 1 / (2 tan 45), m11 = 1 / tan 45.
TEST_F(InfoTest, Projections) {
  write("p.txt", "0.5 0 0 0  0 1 0 0  0 0 -1 -0.2  0 0 -1 0\n");
  expect_lines("p.txt", {"kind: projection", "camera: perspective", "fov_y: 90.0", "aspect: 2.0",
                         "picture: obscura ao DEPTH --projection p.txt -o ao.png"});
  write("left.txt", "0.5 0 0 0  0 1 0 0  0 0 1 -0.2  0 0 1 0\n");
  EXPECT_NE(run("info left.txt").out.find("left-handed"), std::string::npos);
  write("turned.txt", "0.5 0 0 0  0 1 0 0  0 0 -1 -1  0 0 -0.2 0\n");
  expect_failure("info turned.txt", 3, "looks transposed");
  write("inf.txt", "0.5 0 0 0  0 inf 0 0  0 0 -1 -0.2  0 0 -1 0\n");
  expect_failure("info inf.txt", 3, "16 numbers, all finite");
}

}  // namespace
}  // namespace obscura
