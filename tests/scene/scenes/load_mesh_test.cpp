#include "paths.h"
#include "scene/scenes/mesh_view.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "scene/rays/solids.h"
#include "scene/truth/geometric.h"
#include "tests/io/meshes/temporary_folder.h"

namespace obscura::tools {
namespace {

class LoadMesh : public TemporaryFolder {
 protected:
  std::string write_zipped(const std::string& name, const std::string& contents,
                           std::size_t cut = 0) {
    const std::string path = (folder_ / name).string();
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, contents.data(), unsigned(contents.size()));
    gzclose(file);
    if (cut > 0) std::filesystem::resize_file(path, std::filesystem::file_size(path) - cut);
    return path;
  }
  void refuse(const std::string& path, const std::string& message) {
    Mesh mesh;
    mesh.scene_size = -7;
    const Status status = load_mesh(path, &mesh);
    EXPECT_EQ(status.code(), StatusCode::kInvalidInput) << path;
    EXPECT_NE(status.message().find(message), std::string::npos) << status.message();
    EXPECT_EQ(status.message().find(path), 0u) << status.message();
    EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
    EXPECT_EQ(mesh.scene_size, -7);
  }
};

// Corners of the unit cube and its twelve triangles, seen from outside counterclockwise.
const char kCube[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

std::string ply(const std::string& vertices, int vertex_count, const std::string& faces,
                int face_count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

TEST_F(LoadMesh, CubeFromEveryKindOfFile) {
  const std::string as_ply =
      ply("0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n", 8,
          "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 3 0 4 7\n", 6);
  const std::string paths[] = {write("cube.obj", kCube), write("cube.PLY", as_ply),
                               write_zipped("cube.obj.gz", kCube),
                               write_zipped("cube.ply.GZ", as_ply)};
  for (const std::string& path : paths) {
    ASSERT_TRUE(is_mesh(path));
    Mesh mesh;
    const Status status = load_mesh(path, &mesh);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.scene_size, 1);
    EXPECT_NEAR(signed_volume(mesh, 0, 12), 1, 1e-12);
    find_solids(&mesh);
    ASSERT_EQ(mesh.parts.size(), 1u);
    EXPECT_TRUE(mesh.parts[0].closed);
  }
}

// One triangle under two nodes, of which the second doubles and mirrors it.
TEST_F(LoadMesh, NodeTransformsOfGltf) {
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string buffer(reinterpret_cast<const char*>(corners), sizeof corners);
  write("triangle.bin", buffer);
  const std::string path = write("triangle.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "scale": [-2, 2, 2]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"uri": "triangle.bin", "byteLength": 36}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}]})");
  Mesh mesh;
  const Status status = load_mesh(path, &mesh);
  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_EQ(mesh.triangles.size(), 2u);
  const Bounds bounds = bounds_of(mesh);
  EXPECT_EQ(bounds.min.x, -2);
  EXPECT_EQ(bounds.max.x, 6);
  EXPECT_EQ(bounds.max.y, 2);
  for (const Mesh::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.position(t.a);
    EXPECT_GT(cross(mesh.position(t.b) - a, mesh.position(t.c) - a).z, 0);  // the same side
  }
}

TEST_F(LoadMesh, HostileFilesAreRefusedInOneSentence) {
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
  refuse((folder_ / "absent.obj").string(), "there is no such file");
  refuse(folder_.string() + ".obj", "there is no such file");
  std::filesystem::create_directories(folder_ / "folder.obj");
  refuse((folder_ / "folder.obj").string(), "is not a file");
  refuse(write("mesh.stl", "solid"), "not a mesh by its ending; meshes are .obj, .ply");
  refuse(write("mesh.gz", "solid"), "not a mesh by its ending");
  refuse(write("empty.ply", ""), "is empty");
  refuse(write("text.ply", "this is no mesh at all\n"), "does not begin with 'ply'");
  refuse(write("cube.ply", kCube), "does not begin with 'ply'");  // wrong ending
  refuse(write("image.glb", "\x89PNG\r\n\x1a\n0000000000000000"), "is not JSON");
  refuse(write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "holds no triangles");
  refuse(write("points.ply", ply(triangle, 3, "", 0)), "holds no triangles");
  refuse(write("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n"), "no triangles");
  refuse(write("nan.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"), "must be finite");
  refuse(write("inf.ply", ply("0 0 0\n1 0 0\n0 inf 0\n", 3, "3 0 1 2\n", 1)), "must be finite");
  refuse(write("huge.ply", ply("0 0 0\n1e30 0 0\n0 1e39 0\n", 3, "3 0 1 2\n", 1)),
         "must be finite");
  refuse(write("far.ply", ply("0 0 0\n1e30 0 0\n0 1 0\n", 3, "3 0 1 2\n", 1)), "within 1e11");
  refuse(write("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"), "in one point");
  refuse(write("index.ply", ply(triangle, 3, "3 0 1 7\n", 1)), "names vertex 7 of 3");
  refuse(write("negative.ply", ply(triangle, 3, "3 0 1 -2\n", 1)), "names vertex -2 of 3");
  refuse(write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "line 4 names vertex 9 of 3");
  refuse(write_zipped("cut.obj.gz", kCube, 9), "corrupt or cut short");
  refuse(write("plain.obj.gz", kCube), "corrupt or cut short");
  refuse(write_zipped("empty.obj.gz", ""), "is empty");
}

TEST_F(LoadMesh, TruncatedBinaryPly) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 300\nproperty float x\n"
      "property float y\nproperty float z\nelement face 100\n"
      "property list uchar int vertex_indices\nend_header\n";
  std::string body;
  for (int i = 0; i < 900; ++i) {
    const float value = float(std::sin(i * 1.7));
    body.append(reinterpret_cast<const char*>(&value), 4);
  }
  for (int i = 0; i < 100; ++i) {
    body.push_back(3);
    for (int k = 0; k < 3; ++k) {
      const int index = 3 * i + k;
      body.append(reinterpret_cast<const char*>(&index), 4);
    }
  }
  Mesh mesh;
  ASSERT_TRUE(load_mesh(write("whole.ply", header + body), &mesh).ok());
  EXPECT_EQ(mesh.triangles.size(), 100u);
  for (double share : {0.1, 0.5, 0.8, 0.95}) {
    refuse(write("cut.ply", header + body.substr(0, std::size_t(share * double(body.size())))),
           "cut short");
  }
}

TEST_F(LoadMesh, DegenerateTrianglesDoNoHarm) {
  // A cube, a triangle that is a line, one that is a point, and a needle.
  const std::string path = write(
      "cube.obj", std::string(kCube) +
                      "v 3 0 0\nv 4 0 0\nv 5 0 0\nf 9 10 11\nf 9 9 9\nv 4 1e-30 0\nf 9 10 12\n");
  MeshOptions options;
  options.view.size = {48, 32};
  options.view.guard_band = {false, 0, 0};
  options.view.layers = 2;
  Rendering r;
  const Status status = load_mesh(path, options, *make_executor(), &r);
  ASSERT_TRUE(status.ok()) << status.message();
  const auto hits = std::count_if(r.gbuffer.depth.begin(), r.gbuffer.depth.end(),
                                  [](float d) { return std::isfinite(d); });
  EXPECT_GT(hits, 30);
  for (std::size_t i = 0; i < r.gbuffer.depth.size(); ++i) {
    EXPECT_FALSE(std::isnan(r.gbuffer.depth[i]));
    EXPECT_TRUE(std::isfinite(r.gbuffer.normal_x[i]));
    EXPECT_EQ(r.gbuffer.layers[0].front[i], r.gbuffer.depth[i]);
    EXPECT_GE(r.gbuffer.layers[0].back[i], r.gbuffer.layers[0].front[i]);
  }
}

TEST_F(LoadMesh, AMillionTinyTriangles) {
  constexpr int kSide = 708;  // 2 kSide^2 triangles
  std::string body = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string((kSide + 1) * (kSide + 1)) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(2 * kSide * kSide) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  body.reserve(body.size() + 40u * kSide * kSide);
  auto put = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    body.append(bytes, sizeof value);
  };
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) {
      put(float(i * 1e-6));
      put(float(1e-7 * std::sin(i * 0.1) * std::cos(j * 0.1)));
      put(float(j * 1e-6));
    }
  }
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int a = j * (kSide + 1) + i;
      const int b = a + kSide + 1;
      for (const auto& [p, q, r] : {std::tuple(a, b, a + 1), std::tuple(a + 1, b, b + 1)}) {
        body.push_back(3);
        put(p);
        put(q);
        put(r);
      }
    }
  }
  MeshOptions options;
  options.view.size = {64, 36};
  Rendering r;
  const Status status = load_mesh(write("million.ply", body), options, *make_executor(), &r);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_GT(r.scene->mesh().triangles.size(), 1000000u);
  EXPECT_NEAR(r.gbuffer.scene_size, kSide * 1e-6, 1e-8);
  EXPECT_TRUE(std::isfinite(
      r.gbuffer.depth[(r.gbuffer.height / 2) * r.gbuffer.width + r.gbuffer.width / 2]));
}

TEST_F(LoadMesh, DefaultViewFramesTheMesh) {
  const std::string path = write("cube.obj", kCube);
  for (const ImageSize size : {ImageSize{64, 36}, ImageSize{30, 60}}) {
    for (bool orthographic : {false, true}) {
      MeshOptions options;
      options.view.size = size;
      options.view.guard_band = {false, 0, 0};
      if (orthographic) options.view.ortho_height = size.width > size.height ? 1.8 : 3.6;
      Rendering r;
      ASSERT_TRUE(load_mesh(path, options, *make_executor(), &r).ok());
      const int w = size.width, h = size.height;
      int hits = 0;
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
          const bool hit = std::isfinite(r.gbuffer.depth[y * w + x]);
          hits += hit;
          EXPECT_FALSE(hit && (x == 0 || y == 0 || x == w - 1 || y == h - 1));
        }
      }
      EXPECT_GT(hits, std::min(w, h) * std::min(w, h) / 5);
    }
  }
}

TEST_F(LoadMesh, GroundCarriesTheMeshAndDoesNotCount) {
  MeshOptions options;
  options.view.size = {64, 36};
  options.ground = true;
  Rendering r;
  ASSERT_TRUE(load_mesh(write("cube.obj", kCube), options, *make_executor(), &r).ok());
  EXPECT_EQ(r.gbuffer.scene_size, 1);
  RayScene::Hit hit;
  ASSERT_TRUE(r.scene->intersect({3, 5, 0}, {0, -1, 0}, &hit));
  EXPECT_NEAR(hit.t, 5, 1e-6);  // level with the cube's lowest point
}

TEST_F(LoadMesh, PosesThatCannotBeAreRefused) {
  const std::string path = write("cube.obj", kCube);
  auto refused = [&](const ViewOptions& view, const std::string& message) {
    MeshOptions options;
    options.view = view;
    Rendering r;
    const Status status = load_mesh(path, options, *make_executor(), &r);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_NE(status.message().find(message), std::string::npos) << status.message();
  };
  refused({.eye = Vec3{0.5, 0.4, 0.6}}, "lies inside a solid");
  refused({.eye = Vec3{0.5, 5, 0.5}, .look_at = Vec3{0.5, 0, 0.5}}, "along up");
  refused({.eye = Vec3{3, 3, 3}, .look_at = Vec3{3, 3, 3}}, "must differ");
  refused({.up = Vec3{0, 0, 0}}, "up is 0,0,0");
  refused({.layers = -1}, "layers is -1");
  MeshOptions inside;
  inside.view.eye = Vec3{0.5, 0.4, 0.6};
  inside.view.size = {8, 8};
  inside.sheets = true;
  Rendering r;
  EXPECT_TRUE(load_mesh(path, inside, *make_executor(), &r).ok());
}

// A block on a floor, seen from the same side wherever in the world it stands: the truth of its
// geometry does not depend on where that is. Coordinates of a map projection and of the earth's
// centre are where floats have steps of half a metre.
TEST_F(LoadMesh, TheTruthIsTheSameFarFromTheOrigin) {
  auto visibility = [&](Vec3 at) {
    std::string text;
    const double corners[][3] = {{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4},  {4, 0, -4},
                                 {-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1},
                                 {-1, 0, 1},  {1, 0, 1},  {1, 2, 1},  {-1, 2, 1}};
    for (const auto& c : corners) {
      char line[128];
      std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", c[0] + at.x, c[1] + at.y, c[2] + at.z);
      text += line;
    }
    text +=
        "f 1 2 3 4\nf 5 8 7 6\nf 9 10 11 12\nf 5 6 10 9\nf 7 8 12 11\nf 6 7 11 10\nf 8 5 9 12\n";
    MeshOptions options;
    options.view.size = {48, 27};
    options.view.guard_band = {false, 0, 0};
    options.view.eye = at + Vec3{4, 4, 6};
    options.view.look_at = at;
    options.view.fov_y = 50;
    Rendering r;
    const Status status = load_mesh(write("block.obj", text), options, *make_executor(), &r);
    EXPECT_TRUE(status.ok()) << status.message();
    std::vector<float> visible(48 * 27);
    GeometricSettings settings;
    settings.rays = 64;
    EXPECT_TRUE(trace_geometric(r, settings, {.visibility = {visible.data(), 48, 27}}).ok());
    return visible;
  };
  const std::vector<float> here = visibility({0, 0, 0});
  EXPECT_LT(*std::min_element(here.begin(), here.end()), 0.7f);
  for (const Vec3 at : {Vec3{1e4, 1e4, 1e4}, Vec3{448123, 0, 5411987}, Vec3{4.2e6, 1.7e5, 4.8e6}}) {
    const std::vector<float> there = visibility(at);
    double difference = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      difference += std::abs(double(here[i]) - there[i]) / double(here.size());
    }
    EXPECT_LT(difference, 2e-3) << at.x;
  }
}

TEST_F(LoadMesh, SharedMeshes) {
  const std::string folder = OBSCURA_SOURCE_DIR "/../shared/data/meshes/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared meshes beside the sources";
  const std::pair<const char*, std::size_t> files[] = {{"stanford-bunny.obj", 69451},
                                                       {"cornell/CornellBox-Sphere.obj", 2188}};
  for (const auto& [name, triangles] : files) {
    Mesh mesh;
    ASSERT_TRUE(load_mesh(folder + name, &mesh).ok());
    EXPECT_EQ(mesh.triangles.size(), triangles) << name;
  }
}

}  // namespace
}  // namespace obscura::tools
