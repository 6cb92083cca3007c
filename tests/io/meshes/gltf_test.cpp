#include <gtest/gtest.h>

#include <cstring>

#include "io/meshes/load_mesh.h"
#include "tests/io/meshes/temporary_folder.h"

namespace obscura::tools {
namespace {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

// A GLB of a JSON text and a binary chunk.
std::string glb(std::string json, std::string binary) {
  while (json.size() % 4) json += ' ';
  while (binary.size() % 4) binary += '\0';
  std::string out = "glTF";
  auto word = [&](std::size_t value) {
    for (int i = 0; i < 4; ++i) out += char(value >> (8 * i) & 0xFF);
  };
  word(2);
  word(28 + json.size() + binary.size());
  word(json.size());
  out += "JSON" + json;
  word(binary.size());
  out += std::string("BIN\0", 4) + binary;
  return out;
}

class Gltf : public TemporaryFolder {
 protected:
  // One node with one mesh; `more` are further members of the file.
  static std::string file(const std::string& buffer, const std::string& views,
                          const std::string& accessors, const std::string& primitive,
                          const std::string& node = "\"mesh\": 0", const std::string& more = "") {
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{)" + node +
           R"(}], "meshes": [{"primitives": [{)" + primitive + R"(}]}], "buffers": [)" + buffer +
           R"(], "bufferViews": [)" + views + R"(], "accessors": [)" + accessors + "]" + more + "}";
  }
  static std::string triangle(const std::string& more = "",
                              const std::string& node = "\"mesh\": 0") {
    const std::string bytes = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    return file(R"({"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
                    base64(bytes) + "\"}",
                R"({"buffer": 0, "byteLength": 36})",
                R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})",
                R"("attributes": {"POSITION": 0})", node, more);
  }
  Mesh load(const std::string& name, const std::string& contents) {
    Mesh mesh;
    const Status s = load_mesh(write(name, contents), &mesh);
    EXPECT_TRUE(s.ok()) << s.message();
    return mesh;
  }
  void refuse(const std::string& contents, const std::string& message) {
    Mesh mesh;
    const std::string path = write("wrong.gltf", contents);
    const Status s = load_mesh(path, &mesh);
    EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
    EXPECT_NE(s.message().find(message), std::string::npos) << s.message();
    EXPECT_LE(s.message().size() - path.size(), 300u);
  }
};

TEST_F(Gltf, TextAndBinaryFilesAndDataUris) {
  EXPECT_EQ(load("uri.gltf", triangle()).triangles.size(), 1u);
  const std::string views =
      R"({"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3})";
  const std::string accessors =
      R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
         {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"})";
  const std::string binary =
      bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string("\2\0\1", 3);
  const std::string primitive = R"("attributes": {"POSITION": 0}, "indices": 1)";
  const Mesh from_glb =
      load("b.glb", glb(file(R"({"byteLength": 39})", views, accessors, primitive), binary));
  ASSERT_EQ(from_glb.triangles.size(), 1u);
  EXPECT_EQ(from_glb.triangles[0].a, 2u);
  std::filesystem::create_directories(folder_ / "data");
  write("data/a b.bin", binary);
  EXPECT_EQ(load("file.gltf", file(R"({"byteLength": 39, "uri": "data/a%20b.bin"})", views,
                                   accessors, primitive))
                .triangles.size(),
            1u);
}

// KHR_mesh_quantization: whole numbers that a node scales, and normalized ones, which are in [-1,
// 1].
TEST_F(Gltf, QuantizedPositions) {
  const std::string words = bytes_of<std::uint16_t>({0, 0, 0, 0, 1000, 0, 0, 0, 0, 500, 0, 0});
  const auto text = [&](const char* normalized) {
    return file(
        R"({"byteLength": 24})", R"({"buffer": 0, "byteLength": 24, "byteStride": 8})",
        std::string(R"({"bufferView": 0, "componentType": 5123, "count": 3, "type": "VEC3")") +
            normalized + "}",
        R"("attributes": {"POSITION": 0})",
        R"("mesh": 0, "translation": [5, 0, 0], "scale": [0.01, 0.01, 0.01])",
        R"(, "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"])");
  };
  const Mesh mesh = load("q.glb", glb(text(""), words));
  EXPECT_FLOAT_EQ(mesh.position(1).x, 15);
  EXPECT_FLOAT_EQ(mesh.position(2).y, 5);
  const Mesh normalized = load("n.glb", glb(text(R"(, "normalized": true)"), words));
  EXPECT_NEAR(normalized.position(1).x + normalized.origin.x, 5 + 0.01 * 1000 / 65535, 1e-9);
  const std::string shorts = bytes_of<std::int8_t>({0, 0, 0, 0, -128, 0, 0, 0, 0, 127, 0, 0});
  const std::string as_bytes = file(
      R"({"byteLength": 12})", R"({"buffer": 0, "byteLength": 12, "byteStride": 4})",
      R"({"bufferView": 0, "componentType": 5120, "count": 3, "type": "VEC3", "normalized": true})",
      R"("attributes": {"POSITION": 0})");
  const Mesh bytes = load("b.glb", glb(as_bytes, shorts));
  EXPECT_EQ(bytes.position(1).x, -1);
  EXPECT_EQ(bytes.position(2).y, 1);
}

TEST_F(Gltf, StripsFansSparseValuesAndMatrices) {
  const std::string corners = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const std::string view = R"({"buffer": 0, "byteLength": 48})";
  const std::string accessor =
      R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})";
  for (const char* mode : {"5", "6"}) {
    const Mesh mesh = load(
        "strip.glb", glb(file(R"({"byteLength": 48})", view, accessor,
                              std::string(R"("attributes": {"POSITION": 0}, "mode": )") + mode),
                         corners));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    const bool strip = *mode == '5';
    EXPECT_EQ(mesh.triangles[1].a, strip ? 1u : 0u);
    EXPECT_EQ(mesh.triangles[1].b, strip ? 3u : 2u);
    EXPECT_EQ(mesh.triangles[1].c, strip ? 2u : 3u);
  }
  const std::string sparse = corners + bytes_of<std::uint16_t>({3, 0}) + bytes_of<float>({7, 8, 9});
  const std::string text = file(
      R"({"byteLength": 64})",
      view +
          R"(, {"buffer": 0, "byteOffset": 48, "byteLength": 4}, {"buffer": 0, "byteOffset": 52, "byteLength": 12})",
      R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
          "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}}})",
      R"("attributes": {"POSITION": 0}, "mode": 5)",
      R"("mesh": 0, "matrix": [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 10, 1])");
  const Mesh mesh = load("sparse.glb", glb(text, sparse));
  EXPECT_EQ(mesh.position(3).x + mesh.origin.x, 8);
  EXPECT_EQ(mesh.position(3).y + mesh.origin.y, 7);
  EXPECT_EQ(mesh.position(3).z + mesh.origin.z, 19);
  // The matrix swaps two axes, which mirrors: corners change places so that outsides stay outside.
  EXPECT_EQ(mesh.triangles[0].b, 2u);
}

TEST_F(Gltf, WhatIsNotReadIsSaid) {
  refuse(triangle(R"(, "extensionsRequired": ["KHR_draco_mesh_compression"])"),
         "requires the extension KHR_draco_mesh_compression, which is not read; write it without "
         "mesh");
  refuse(triangle(R"(, "extensionsRequired": ["EXT_meshopt_compression"])"),
         "EXT_meshopt_compression");
  refuse(triangle(R"(, "extensionsRequired": ["ACME_teapots"])"), "ACME_teapots");
  EXPECT_EQ(load("m.gltf", triangle(R"(, "extensionsRequired": ["KHR_materials_unlit"])"))
                .triangles.size(),
            1u);
}

TEST_F(Gltf, HostileFilesAreRefusedInOneSentence) {
  refuse(std::string(200000, '['), "nested 200000 deep");
  refuse(triangle(", \"extras\": " + std::string(100, '[') + std::string(100, ']')),
         "nested 101 deep");
  refuse("{\"asset\": {}", "is not JSON");
  refuse("[1]", "no object");
  refuse(triangle("", R"("mesh": 0, "children": [0])"), "node 0 with two parents");
  refuse(triangle("", R"("mesh": 7)"), "names element 7 of 'meshes', which has 1");
  refuse(triangle("", R"("mesh": -1)"), "'mesh' that is no whole number");
  refuse(triangle("", R"("mesh": 0, "matrix": [1, 2])"), "'matrix' that is not 16 numbers");
  const std::string view = R"({"buffer": 0, "byteLength": 36})";
  const std::string accessor =
      R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})";
  const std::string position = R"("attributes": {"POSITION": 0})";
  write("b.bin", std::string(36, '\0'));
  const std::string buffer = R"({"byteLength": 36, "uri": "b.bin"})";
  refuse(file(R"({"byteLength": 37, "uri": "b.bin"})", view, accessor, position),
         "should have 37 bytes and has 36");
  refuse(file(R"({"byteLength": 36, "uri": "../b.bin"})", view, accessor, position),
         "its own folder only");
  refuse(file(R"({"byteLength": 36, "uri": "/dev/zero"})", view, accessor, position),
         "its own folder only");
  refuse(file(R"({"byteLength": 36, "uri": "http://a/b"})", view, accessor, position),
         "its own folder only");
  refuse(file(R"({"byteLength": 36, "uri": "absent.bin"})", view, accessor, position),
         "there is no such file");
  refuse(file(buffer, R"({"buffer": 0, "byteOffset": 4, "byteLength": 36})", accessor, position),
         "bufferView 0 that reaches beyond its buffer");
  refuse(file(buffer, view,
              R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})", position),
         "accessor of 4 elements that reaches beyond bufferView 0");
  refuse(
      file(buffer, view,
           R"({"bufferView": 0, "componentType": 5126, "count": 1000000000000000, "type": "VEC3"})",
           position),
      "reaches beyond bufferView 0");
  refuse(file(buffer, view, R"({"componentType": 5126, "count": 4000000000, "type": "VEC3"})",
              position),
         "has no bytes for the positions");
  refuse(file(buffer, view,
              R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"})", position),
         "not of type VEC3");
}

// Two nodes at each of 40 levels share the level below: 2^40 triangles, were they trees.
TEST_F(Gltf, SharedNodesDoNotMultiply) {
  std::string nodes;
  for (int i = 1; i <= 40; ++i) {
    nodes +=
        "{\"mesh\": 0, \"children\": [" + std::to_string(i) + ", " + std::to_string(i) + "]}, ";
  }
  std::string text = triangle();
  text.replace(text.find("{\"mesh\": 0}"), 11, nodes + "{\"mesh\": 0}");
  refuse(text, "with two parents");
}

// A chain of 60,000 nodes is legal, and no reason to run out of stack.
TEST_F(Gltf, DeepTreesOfNodes) {
  std::string nodes;
  for (int i = 1; i <= 60000; ++i) nodes += "{\"children\": [" + std::to_string(i) + "]}, ";
  std::string text = triangle();
  text.replace(text.find("{\"mesh\": 0}"), 11, nodes + "{\"mesh\": 0}");
  EXPECT_EQ(load("deep.gltf", text).triangles.size(), 1u);
}

// Ten thousand nodes with one mesh of ten thousand corners: 100 million corners from 1 MB.
TEST_F(Gltf, MeshesRepeatedWithoutMeasureAreRefused) {
  constexpr int kCorners = 9999;
  const std::string binary(12 * kCorners, '\1');
  std::string text =
      file(R"({"byteLength": 119988})", R"({"buffer": 0, "byteLength": 119988})",
           R"({"bufferView": 0, "componentType": 5126, "count": 9999, "type": "VEC3"})",
           R"("attributes": {"POSITION": 0})");
  std::string nodes = "{\"mesh\": 0}", roots = "0";
  for (int i = 1; i < 10000; ++i) {
    nodes += ", {\"mesh\": 0}";
    roots += ", " + std::to_string(i);
  }
  text.replace(text.find("{\"mesh\": 0}"), 11, nodes);
  text.replace(text.find("[0]"), 3, "[" + roots + "]");
  Mesh mesh;
  const Status s = load_mesh(write("many.glb", glb(text, binary)), &mesh);
  EXPECT_NE(s.message().find("repeats its meshes until"), std::string::npos) << s.message();
}

}  // namespace
}  // namespace obscura::tools
