#include <gtest/gtest.h>

#include "io/meshes/load_mesh.h"
#include "tests/io/meshes/temporary_folder.h"

namespace obscura::tools {
namespace {

class Obj : public TemporaryFolder {
 protected:
  Mesh load(const std::string& contents) {
    Mesh mesh;
    const Status s = load_mesh(write("mesh.obj", contents), &mesh);
    EXPECT_TRUE(s.ok()) << s.message();
    return mesh;
  }
  std::string failure(const std::string& contents) {
    Mesh mesh;
    return load_mesh(write("wrong.obj", contents), &mesh).message();
  }
};

TEST_F(Obj, EverySpellingOfAFace) {
  const std::string vertices =
      "# corners\nv 0 0 0 1.0\r\nv\t1 0 0 0.5 0.5 0.5\nv +1 1e0 0 # here\nv 0 1 0\n";
  for (const char* face : {"f 1 2 3 4", "f 1/7 2/7 3/7 4/7", "f 1//9 2//9 3//9 4//9",
                           "f 1/7/9 2/7/9 3/7/9 4/7/9", "f -4 -3 -2 -1", "f 1 2 \\\n3 4 # end",
                           "g group\nusemtl m\ns off\nf 1 2 3 4\nl 1 2\np 1"}) {
    const Mesh mesh = load(vertices + face);
    ASSERT_EQ(mesh.triangles.size(), 2u) << face;
    EXPECT_EQ(mesh.triangles[1].b, 2u);
    EXPECT_EQ(mesh.triangles[1].c, 3u);
  }
  // Faces before the vertices that they name, as some exporters write them.
  EXPECT_EQ(load("f 1 2 3\n" + vertices).triangles.size(), 1u);
}

TEST_F(Obj, RelativeIndicesCountFromWhereTheyStand) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -2 -1\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1].a, 0u);
  EXPECT_EQ(mesh.triangles[1].b, 2u);
  EXPECT_EQ(mesh.triangles[1].c, 3u);
}

TEST_F(Obj, WrongLinesAreNamed) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_NE(failure("v 0 0\nf 1 1 1\n").find("line 1 has '' for a coordinate"), std::string::npos);
  EXPECT_NE(failure("v 0 0,5 1\n").find("line 1 has '0,5' for a coordinate"), std::string::npos);
  EXPECT_NE(failure(vertices + "f 1 2 0\n").find("line 4 has '0' for a corner"), std::string::npos);
  EXPECT_NE(failure(vertices + "\n\nf 1 2 4\n").find("line 6 names vertex 4 of 3"),
            std::string::npos);
  EXPECT_NE(failure(vertices + "f 1 2 -4\n").find("names vertex 0 of 3"), std::string::npos);
  EXPECT_NE(failure(vertices + "f 1 2 99999999999999999999\n").find("for a corner"),
            std::string::npos);
  std::string backslashes;
  for (int i = 0; i < 40000; ++i) backslashes += std::string(60, ' ') + "\\\n";
  EXPECT_NE(failure(backslashes).find("is longer than 1 MiB"), std::string::npos);
}

}  // namespace
}  // namespace obscura::tools
