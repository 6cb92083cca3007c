#ifndef OBSCURA_IO_MESHES_MESH_BUILDER_H_
#define OBSCURA_IO_MESHES_MESH_BUILDER_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/meshes/mesh.h"
#include "obscura/status.h"

namespace obscura::tools {

// Collects what a mesh file holds, in double, and makes a Mesh of it. Used by every reader, so that
// all files are checked, cut into triangles and moved to their centre in the same way.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string path) : path_(std::move(path)) {}

  std::size_t vertex_count() const { return vertices_.size(); }
  void reserve(std::size_t vertices, std::size_t triangles) {
    vertices_.reserve(vertices);
    triangles_.reserve(triangles);
  }
  // `single_precision`: the file gives the vertex as 32-bit floats.
  void add_vertex(Vec3 position, bool single_precision) {
    vertices_.push_back(position);
    single_precision_ = single_precision_ || single_precision;
  }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles_.push_back({a, b, c});
  }
  // Polygons of fewer than three corners are left out. All corners must be below vertex_count().
  void add_polygon(std::span<const std::uint32_t> corners);

  // One part of sheets. Positions are moved by the centre of the bounding box where they lie so far
  // from the origin that floats would lose detail (Mesh::origin).
  Status finish(Mesh* mesh);

 private:
  Status check_extent(const Bounds& bounds) const;
  void announce_lost_detail(const Bounds& bounds, Mesh* mesh) const;

  const std::string path_;
  std::vector<Vec3> vertices_;
  std::vector<Mesh::Triangle> triangles_;
  bool single_precision_ = false;
  // Some seconds of cutting concave polygons; false once they are spent.
  std::int64_t work_ = 2'000'000'000;
  bool cut_ = true;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_MESH_BUILDER_H_
