// obscura bake: visibility and bent normals at vertices, checked where they are known.
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/command/run_command.h"

namespace obscura {
namespace {

struct Vertex {
  float x, y, z, nx, ny, nz;
  int red, green, blue;
  float visibility;
};

std::string ply(const std::vector<std::string>& vertices, const std::vector<std::string>& faces) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(faces.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const std::string& v : vertices) text += v + "\n";
  for (const std::string& f : faces) text += "3 " + f + "\n";
  return text;
}

// A floor triangle with a vertex at the foot of a wall that is so large that it covers half the
// hemisphere there.
const std::vector<std::string> kCorner{"0 0 1",    "2 0 3",       "-2 0 3",      "-8000 0 0",
                                       "8000 0 0", "8000 8000 0", "-8000 8000 0"};
const std::vector<std::string> kCornerFaces{"0 2 1", "3 4 5", "3 5 6"};
constexpr const char* kWhole = " --falloff constant --radius inf --rays 4096 -q";

class Bake : public CommandTest {
 protected:
  // Vertices of a result whose positions are floats.
  std::vector<Vertex> vertices(const std::string& name) const {
    const std::string bytes = read_file(path(name)), end = "end_header\n", key = "element vertex ";
    EXPECT_NE(bytes.find("property float x\n"), std::string::npos);
    const std::size_t count = std::stoul(bytes.substr(bytes.find(key) + key.size()));
    std::vector<Vertex> all;
    constexpr std::size_t kBytes = 6 * 4 + 3 + 4;
    const std::size_t body = bytes.find(end) + end.size();
    EXPECT_GE(bytes.size(), body + count * kBytes);
    for (std::size_t i = 0; i < count && bytes.size() >= body + count * kBytes; ++i) {
      const char* at = bytes.data() + body + i * kBytes;
      float f[6], visibility = 0;
      std::memcpy(f, at, sizeof f);
      std::memcpy(&visibility, at + 27, sizeof visibility);
      const auto* grey = reinterpret_cast<const unsigned char*>(at + 24);
      all.push_back({f[0], f[1], f[2], f[3], f[4], f[5], grey[0], grey[1], grey[2], visibility});
    }
    return all;
  }
};

// What is in front of a corner's normal is no part of a convex solid.
TEST_F(Bake, ACubesCornersAreOpen) {
  write("cube.obj",
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
  expect_success(std::string("bake cube.obj -o cube.ply") + kWhole);
  const std::vector<Vertex> all = vertices("cube.ply");
  ASSERT_EQ(all.size(), 8U);
  for (const Vertex& v : all) {
    EXPECT_EQ(v.visibility, 1);
    EXPECT_EQ(v.red, 255);
    EXPECT_GT(v.nx * v.x, 0);
    EXPECT_GT(v.ny * v.y, 0);
    EXPECT_GT(v.nz * v.z, 0);
  }
}

TEST_F(Bake, AWallHidesHalfOfTheFloorsLight) {
  write("corner.ply", ply(kCorner, kCornerFaces));
  expect_success(std::string("bake corner.ply -o out.ply") + kWhole);
  const std::vector<Vertex> all = vertices("out.ply");
  ASSERT_EQ(all.size(), kCorner.size());
  const Vertex& v = all[0];
  EXPECT_NEAR(v.visibility, 0.5, 0.04);  // five standard deviations of 4096 rays
  EXPECT_EQ(v.red, std::lround(255 * v.visibility));
  EXPECT_EQ(v.green, v.red);
  EXPECT_EQ(v.blue, v.red);
  // The mean direction of a quarter of a sphere lies between its two planes' normals.
  EXPECT_NEAR(v.nx, 0, 0.06);
  EXPECT_NEAR(v.ny, std::sqrt(0.5), 0.06);
  EXPECT_NEAR(v.nz, std::sqrt(0.5), 0.06);
  EXPECT_NEAR(v.nx * v.nx + v.ny * v.ny + v.nz * v.nz, 1, 1e-5);

  // The surface's normal is that of its triangle; a wall beyond the radius hides nothing.
  expect_success(
      "bake corner.ply -o near.ply --normals surface --falloff constant --radius 0.9 -q");
  const Vertex near = vertices("near.ply")[0];
  EXPECT_EQ(near.visibility, 1);
  EXPECT_EQ(near.nx, 0);
  EXPECT_EQ(near.ny, 1);
  EXPECT_EQ(near.nz, 0);
}

// Every kind of file, any number of threads.
TEST_F(Bake, TheSameMeshGivesTheSameBytes) {
  write("corner.ply", ply(kCorner, kCornerFaces));
  std::string obj, positions, indices;
  for (const std::string& v : kCorner) {
    obj += "v " + v + "\n";
    std::istringstream words(v);
    for (float number = 0; words >> number;) {
      positions.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
  }
  for (const std::string& f : kCornerFaces) {
    std::istringstream words(f);
    obj += "f";
    for (std::uint32_t corner = 0; words >> corner;) {
      obj += " " + std::to_string(corner + 1);
      indices.append(reinterpret_cast<const char*>(&corner), sizeof corner);
    }
    obj += "\n";
  }
  write("corner.obj", obj);
  write("corner.bin", positions + indices);
  write("corner.gltf",
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
        R"("buffers":[{"uri":"corner.bin","byteLength":120}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":84},)"
        R"({"buffer":0,"byteOffset":84,"byteLength":36}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":7,"type":"VEC3",)"
        R"("min":[-8000,0,0],"max":[8000,8000,3]},)"
        R"({"bufferView":1,"componentType":5125,"count":9,"type":"SCALAR"}]})");
  expect_success("bake corner.ply -o a.ply -q --threads 1");
  const std::string a = read_file(path("a.ply"));
  ASSERT_FALSE(a.empty());
  for (const char* other : {"corner.obj --threads 3", "corner.gltf --threads 2"}) {
    expect_success(std::string("bake -q -o b.ply ") + other);
    EXPECT_EQ(read_file(path("b.ply")), a) << other;
  }
  expect_success("bake -q -o b.ply corner.ply --seed 2");
  EXPECT_NE(read_file(path("b.ply")), a);
}

// Coordinates that floats cannot hold come back as they were.
TEST_F(Bake, KeepsTheWorldsCoordinates) {
  write("far.ply", ply({"6378137.125 0 0", "6378138.125 0 0", "6378137.125 1 0"}, {"0 1 2"}));
  expect_success("bake far.ply -o out.ply -q");
  const std::string bytes = read_file(path("out.ply")), end = "end_header\n";
  EXPECT_NE(bytes.find("property double x\n"), std::string::npos);
  double x = 0;
  ASSERT_GT(bytes.size(), bytes.find(end) + end.size() + sizeof x);
  std::memcpy(&x, bytes.data() + bytes.find(end) + end.size(), sizeof x);
  EXPECT_EQ(x, 6378137.125);
  expect_success("bake out.ply -o again.ply -q");  // what was written can be read
  EXPECT_EQ(read_file(path("again.ply")), bytes);
}

TEST_F(Bake, TakesMeshesThatAreNotClean) {
  // Three triangles at an edge, a vertex twice, a triangle without area, a vertex of none.
  write("odd.ply", ply({"0 0 0", "1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 0", "9 9 9"},
                       {"0 1 2", "1 0 3", "0 1 4", "5 1 2", "0 0 1"}));
  const CommandResult r = run("bake odd.ply -o out.ply");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("1 of 7 vertices belong to no triangle"), std::string::npos) << r.err;
  EXPECT_NE(r.out.find("out.ply: 7 vertices, 5 triangles"), std::string::npos) << r.out;
  const std::vector<Vertex> all = vertices("out.ply");
  ASSERT_EQ(all.size(), 7U);
  for (const Vertex& v : all) {
    EXPECT_TRUE(v.visibility >= 0 && v.visibility <= 1);
    EXPECT_NEAR(std::hypot(v.nx, v.ny, v.nz), 1, 1e-5);
  }
}

TEST_F(Bake, RefusesWhatItCannotBake) {
  write("one.ply", ply({"0 0 0", "1 0 0", "0 1 0"}, {"0 1 2"}));
  write("none.ply", ply({"0 0 0", "1 0 0", "0 1 0"}, {}));
  write("nan.ply", ply({"0 0 0", "nan 0 0", "0 1 0"}, {"0 1 2"}));
  write("index.ply", ply({"0 0 0", "1 0 0", "0 1 0"}, {"0 1 3"}));
  expect_failure("bake none.ply -o o.ply", 3, "none.ply");
  expect_failure("bake nan.ply -o o.ply", 3, "nan.ply");
  expect_failure("bake index.ply -o o.ply", 3, "index.ply");
  expect_failure("bake scene:hall -o o.ply", 3, "scene:hall");
  expect_failure("bake one.ply -o o.obj", 2, "--output is 'o.obj'; it must end in .ply");
  expect_failure("bake one.ply -o o.ply --normals up", 2,
                 "--normals is 'up'; it must be one of bent, surface");
  expect_failure("bake one.ply -o o.ply --rays 0", 2, "--rays");
  expect_failure("bake one.ply -o o.ply --radius -1", 2, "--radius");
  expect_failure("bake one.ply -o one.ply", 2, "one.ply");
  EXPECT_FALSE(std::filesystem::exists(path("o.ply")));
}

}  // namespace
}  // namespace obscura
