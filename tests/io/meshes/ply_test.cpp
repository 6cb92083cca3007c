#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <functional>

#include "io/meshes/load_mesh.h"
#include "tests/io/meshes/temporary_folder.h"

namespace obscura::tools {
namespace {

class Ply : public TemporaryFolder {
 protected:
  void refuse(const std::string& contents, const std::string& message) {
    Mesh mesh;
    const std::string path = write("wrong.ply", contents);
    const Status s = load_mesh(path, &mesh);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find(message), std::string::npos) << s.message();
    EXPECT_LE(s.message().size() - path.size(), 300u);
    for (char c : s.message()) EXPECT_TRUE(c >= ' ' && c <= '~');
  }
};

template <class T>
void put(std::string* bytes, T value, bool big) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  const bool swap = big != (std::endian::native == std::endian::big);
  for (std::size_t i = 0; i < sizeof(T); ++i) *bytes += raw[swap ? sizeof(T) - 1 - i : i];
}

// A tetrahedron with what other programs add: colours, a list of numbers, an element of its own.
std::string tetrahedron(const std::string& format) {
  std::string bytes = "ply\r\ncomment before the format\r\nformat " + format +
                      " 1.0\r\nobj_info from nowhere\r\nelement vertex 4\r\nproperty double z\r\n"
                      "property uchar red\r\nproperty list uchar short weights\r\n"
                      "property float x\r\nproperty int y\r\nelement camera 1\r\n"
                      "property ushort id\r\nelement face 4\r\nproperty uchar flags\r\n"
                      "property list uint uint vertex_index\r\nend_header\r\n";
  const int p[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const int f[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const bool big = format == "binary_big_endian";
  if (format == "ascii") {
    for (const auto& v : p) {
      bytes += std::to_string(v[2]) + " 200 2 -7 +8 " + std::to_string(v[0]) + ".0e0 " +
               std::to_string(v[1]) + "\n";
    }
    bytes += "9\n";
    for (const auto& c : f) {
      bytes += "1 3";
      for (int corner : c) bytes += " " + std::to_string(corner);
      bytes += "\n";
    }
    return bytes;
  }
  for (const auto& v : p) {
    put(&bytes, double(v[2]), big);
    put(&bytes, std::uint8_t(200), big);
    put(&bytes, std::uint8_t(2), big);
    put(&bytes, std::int16_t(-7), big);
    put(&bytes, std::int16_t(8), big);
    put(&bytes, float(v[0]), big);
    put(&bytes, v[1], big);
  }
  put(&bytes, std::uint16_t(9), big);
  for (const auto& c : f) {
    put(&bytes, std::uint8_t(1), big);
    put(&bytes, std::uint32_t(3), big);
    for (int corner : c) put(&bytes, std::uint32_t(corner), big);
  }
  return bytes;
}

TEST_F(Ply, EveryFormatGivesTheSame) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    Mesh mesh;
    const Status s = load_mesh(write("t.ply", tetrahedron(format)), &mesh);
    ASSERT_TRUE(s.ok()) << s.message();
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.position(1).x, 2);
    EXPECT_EQ(mesh.position(2).y, 2);
    EXPECT_EQ(mesh.position(3).z, 2);
    EXPECT_EQ(mesh.triangles[3].c, 3u);
    EXPECT_EQ(mesh.scene_size, 2);
  }
}

TEST_F(Ply, StripsOfTriangles) {
  Mesh mesh;
  const Status s = load_mesh(
      write("strip.ply",
            "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
            "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
            "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 -1 2 3 4 -1\n"),
      &mesh);
  ASSERT_TRUE(s.ok()) << s.message();
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (const Mesh::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.position(t.a);
    EXPECT_GT(cross(mesh.position(t.b) - a, mesh.position(t.c) - a).z, 0);
  }
}

// Half a metre of detail at coordinates of a map projection: floats there step by half a metre.
TEST_F(Ply, FarFromTheOriginDetailIsKeptAndLostDetailIsSaid) {
  auto file = [](const char* type) {
    return std::string("ply\nformat ascii 1.0\nelement vertex 4\nproperty ") + type +
           " x\nproperty " + type + " y\nproperty " + type +
           " z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
           "5411992.125 448126.25 0\n5411992.375 448126.25 0\n5411992.375 448126.75 0\n"
           "5411992.125 448126.75 0.125\n3 0 1 2\n3 0 2 3\n";
  };
  Mesh mesh;
  ASSERT_TRUE(load_mesh(write("double.ply", file("double")), &mesh).ok());
  EXPECT_EQ(mesh.scene_size, 0.5);
  EXPECT_EQ(mesh.position(1).x + mesh.origin.x, 5411992.375);
  EXPECT_EQ(mesh.position(3).z + mesh.origin.z, 0.125);
  EXPECT_TRUE(mesh.notes.empty());
  ASSERT_TRUE(load_mesh(write("float.ply", file("float")), &mesh).ok());
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_NE(mesh.notes[0].find("detail was lost"), std::string::npos) << mesh.notes[0];
}

TEST_F(Ply, HeadersThatLieAreRefusedInOneSentence) {
  const std::string vertices =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string head = "ply\nformat ascii 1.0\n" + vertices;
  const std::string list = "property list uchar int vertex_indices\nend_header\n";
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  refuse("ply\nformat ascii 1.0\ncomment", "no line 'end_header'");
  refuse("ply\nformat ascii 1.0\nelement vertex 3", "no line 'end_header'");
  refuse(head + "element face 400000000\n" + list + body, "promises 400000000 of 'face'");
  refuse(head + "element face 99999999999999999999\n" + list + body, "must be a whole number");
  refuse(head + "element face -1\n" + list + body, "must be a whole number");
  refuse(head + "element face 1\nproperty list uchar int vertex_indi#es\nend_heaDer\n" + body,
         "'end_heaDer', which is no keyword");
  refuse(head + "element face 1\nproperty list uchar quad vertex_indices\nend_header\n" + body,
         "property of type 'quad'");
  refuse(head + "element face 1\nproperty list float int vertex_indices\nend_header\n" + body,
         "list whose length is of type 'float'");
  refuse("ply\n" + vertices + "end_header\n0 0 0\n", "no line 'format'");
  refuse("ply\nformat morse 1.0\n" + vertices + "end_header\n", "format 'morse'");
  refuse("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "before any element");
  refuse("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
         "no x, y and z");
  // Lengths that no whole number holds, or whose bytes none holds.
  for (const char* length :
       {"9223372036854775808", "18446744073709551616", "1e300", "inf", "nan"}) {
    refuse(head + "element face 1\n" + list + "0 0 0\n1 0 0\n0 1 0\n" + length + " 0 1 2\n",
           "more than the file holds");
  }
  refuse(head + "element face 1\n" + list + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
         "is cut short in 'face' 0");
  refuse(head + "element face 1\n" + list + "0 0 0\n1 0 \x1b[2J\n0 1 0\n3 0 1 2\n",
         "'?[2J' for a number in 'vertex' 1");
  refuse(head + "element face 1\n" + list + "0 0 0\n1 0 0\n0 1 0\n200 0 1 2\n",
         "a list of 200 entries, more than the file holds");
  refuse(head + "element face 1\n" + list + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
         "face 0 names vertex 3 of 3");
  refuse(head + "element face 1\n" + list + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
         "face 0 names vertex -1 of 3");
  refuse(head + "element face 1\n" + list + "0 0 0\n1 0 0\n0 1 0\n3 0 1 nan\n", "names vertex nan");
  // Elements without properties take no bytes, however many there are.
  refuse(head + "element nothing 18446744073709551615\nend_header\n0 0 0\n1 0 0\n0 1 0\n",
         "holds no triangles");
}

// Whatever byte of a file is changed or missing, reading ends, with a mesh or with one sentence.
TEST_F(Ply, DamagedFilesEnd) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string whole = tetrahedron(format);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const auto& damaged :
           {whole.substr(0, at),
            whole.substr(0, at) + char(whole[at] ^ 0x55) + whole.substr(at + 1),
            whole.substr(0, at) + '\xff' + whole.substr(at + 1)}) {
        Mesh mesh;
        const Status s = load_mesh(write("damaged.ply", damaged), &mesh);
        EXPECT_TRUE(s.ok() || s.message().find('\n') == std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace obscura::tools
