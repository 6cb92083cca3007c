#include "io/meshes/read_gltf.h"

#include <fmt/format.h>

#include <array>

#include "io/meshes/gltf_document.h"
#include "io/meshes/words.h"

namespace obscura::tools {
namespace {

using Json = GltfDocument::Json;

// Rows of an affine transform.
struct Transform {
  std::array<std::array<double, 4>, 3> row{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Vec3 operator()(Vec3 p) const {
    auto dot = [&](int i) {
      const auto& r = row[std::size_t(i)];
      return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
    };
    return {dot(0), dot(1), dot(2)};
  }
  Transform operator*(const Transform& b) const {
    Transform c;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        c.row[i][k] = row[i][0] * b.row[0][k] + row[i][1] * b.row[1][k] + row[i][2] * b.row[2][k] +
                      (k == 3 ? row[i][3] : 0);
      }
    }
    return c;
  }
  bool mirrors() const {
    const auto& [a, b, c] = row;
    return dot(Vec3{a[0], a[1], a[2]}, cross(Vec3{b[0], b[1], b[2]}, Vec3{c[0], c[1], c[2]})) < 0;
  }
};

Transform transform_of(const Json& node) {
  Transform t;
  if (const std::vector<double> m = GltfDocument::numbers(node, "matrix", 16); !m.empty()) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) t.row[i][k] = m[4 * k + i];
    }
    return t;
  }
  const std::vector<double> move = GltfDocument::numbers(node, "translation", 3);
  const std::vector<double> turn = GltfDocument::numbers(node, "rotation", 4);
  const std::vector<double> scale = GltfDocument::numbers(node, "scale", 3);
  if (!turn.empty()) {
    const double x = turn[0], y = turn[1], z = turn[2], w = turn[3];
    t.row = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
              {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
              {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3 && !scale.empty(); ++k) t.row[i][k] *= scale[k];
    if (!move.empty()) t.row[i][3] = move[i];
  }
  return t;
}

// Extensions that say nothing of where triangles are, or that are read.
bool harmless(std::string_view extension) {
  if (extension == "KHR_mesh_quantization") return true;
  for (std::string_view prefix : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                                  "KHR_lights_", "KHR_xmp", "KHR_animation_", "EXT_lights_"}) {
    if (extension.starts_with(prefix)) return true;
  }
  return false;
}

void check_extensions(const Json& root) {
  const auto required = root.find("extensionsRequired");
  if (required == root.end() || !required->is_array()) return;
  for (const Json& name : *required) {
    if (!name.is_string()) continue;
    const auto& extension = name.get_ref<const std::string&>();
    if (harmless(extension)) continue;
    const bool compressed =
        extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression";
    throw GltfError(fmt::format("requires the extension {}, which is not read{}",
                                printable(extension),
                                compressed ? "; write it without mesh compression" : ""));
  }
}

class GltfReader {
 public:
  GltfReader(GltfDocument* document, MeshBuilder* builder) : doc_(*document), builder_(*builder) {}

  void read() {
    check_extensions(doc_.root());
    visited_.resize(doc_.size("nodes"));
    for (std::int64_t root : roots()) stack_.push_back({root, Transform()});
    while (!stack_.empty()) {
      const Visit visit = stack_.back();
      stack_.pop_back();
      add_node(visit);
    }
  }

 private:
  struct Visit {
    std::int64_t node;
    Transform parent;
  };

  static std::vector<std::int64_t> list(const Json& object, const char* key) {
    std::vector<std::int64_t> values;
    const auto found = object.find(key);
    if (found == object.end()) return values;
    if (!found->is_array()) throw GltfError(fmt::format("has '{}' that is no array", key));
    for (const Json& value : *found) {
      if (!value.is_number_integer())
        throw GltfError(fmt::format("has '{}' that are no indices", key));
      values.push_back(value.get<std::int64_t>());
    }
    return values;
  }

  // Nodes of the default scene, or of the first; without scenes, those that are no one's children.
  std::vector<std::int64_t> roots() const {
    if (doc_.size("scenes") > 0) {
      return list(doc_.element("scenes", GltfDocument::whole(doc_.root(), "scene", 0)), "nodes");
    }
    std::vector<bool> child(doc_.size("nodes"));
    for (std::size_t i = 0; i < child.size(); ++i) {
      for (std::int64_t c : list(doc_.element("nodes", std::int64_t(i)), "children")) {
        if (c >= 0 && std::size_t(c) < child.size()) child[std::size_t(c)] = true;
      }
    }
    std::vector<std::int64_t> result;
    for (std::size_t i = 0; i < child.size(); ++i) {
      if (!child[i]) result.push_back(std::int64_t(i));
    }
    return result;
  }

  void add_node(const Visit& visit) {
    const Json& node = doc_.element("nodes", visit.node);
    // Nodes form trees, so that what a file holds is bounded by its size.
    if (visited_[std::size_t(visit.node)]) {
      throw GltfError(
          fmt::format("has a node {} with two parents; nodes of glTF form trees", visit.node));
    }
    visited_[std::size_t(visit.node)] = true;
    const Transform transform = visit.parent * transform_of(node);
    for (std::int64_t child : list(node, "children")) stack_.push_back({child, transform});
    const std::int64_t mesh = GltfDocument::whole(node, "mesh", -1);
    if (mesh >= 0) add_mesh(doc_.element("meshes", mesh), transform);
  }

  void add_mesh(const Json& mesh, const Transform& transform) {
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) {
      throw GltfError("has a mesh without primitives");
    }
    for (const Json& p : *primitives) {
      if (!p.is_object()) throw GltfError("has a primitive that is no object");
      const std::int64_t mode = GltfDocument::whole(p, "mode", 4);
      if (mode >= 4 && mode <= 6) add_primitive(p, mode, transform);  // others: points and lines
    }
  }

  void add_primitive(const Json& primitive, std::int64_t mode, const Transform& transform) {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object() ||
        !attributes->contains("POSITION")) {
      return;
    }
    bool single = false;
    const std::vector<Vec3> positions =
        doc_.positions(GltfDocument::whole(*attributes, "POSITION", 0), &single);
    std::vector<std::uint32_t> corners;
    if (primitive.contains("indices")) {
      corners = doc_.indices(GltfDocument::whole(primitive, "indices", 0));
    } else {
      corners.resize(positions.size());
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = std::uint32_t(i);
    }
    check_expansion(positions.size() + corners.size());
    for (std::uint32_t corner : corners) {
      if (corner < positions.size()) continue;
      throw GltfError(
          fmt::format("has a face that names vertex {} of {}", corner, positions.size()));
    }
    const auto first = std::uint32_t(builder_.vertex_count());
    for (Vec3 p : positions) builder_.add_vertex(transform(p), single);
    add_triangles(corners, mode, first, transform.mirrors());
  }

  void add_triangles(const std::vector<std::uint32_t>& c, std::int64_t mode, std::uint32_t first,
                     bool mirrored) {
    auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
      if (mirrored) std::swap(j, k);
      builder_.add_triangle(first + c[i], first + c[j], first + c[k]);
    };
    for (std::size_t i = 0; i + 2 < c.size(); i += mode == 4 ? 3 : 1) {
      if (mode == 4) add(i, i + 1, i + 2);
      if (mode == 5) add(i, i + 1 + i % 2, i + 2 - i % 2);
      if (mode == 6) add(0, i + 1, i + 2);
    }
  }

  // Nodes may share meshes, and primitives share bytes: a small file can stand for any number of
  // triangles.
  void check_expansion(std::size_t elements) {
    expanded_ += elements;
    const std::size_t most = 4'000'000 + 16 * doc_.total_bytes();
    if (expanded_ <= most && builder_.vertex_count() + elements < 0xFFFFFFFF) return;
    throw GltfError(
        fmt::format("repeats its meshes until {} bytes stand for more than {} vertices and "
                    "corners",
                    doc_.total_bytes(), most));
  }

  GltfDocument& doc_;
  MeshBuilder& builder_;
  std::vector<bool> visited_;
  std::vector<Visit> stack_;
  std::size_t expanded_ = 0;
};

}  // namespace

Status read_gltf(const std::string& path, std::string_view bytes, MeshBuilder* builder) {
  try {
    GltfDocument document(path, bytes);
    GltfReader(&document, builder).read();
    return {};
  } catch (const GltfError& e) {
    return invalid_input(fmt::format("{}: {}", path, e.what()));
  }
}

}  // namespace obscura::tools
