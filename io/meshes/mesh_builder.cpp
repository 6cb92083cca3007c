#include "io/meshes/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/meshes/polygon.h"

namespace obscura::tools {
namespace {

// Coordinates are moved where they reach farther than so many of the mesh's longest sides: nearer,
// floats keep 21 bits of the mesh's size.
constexpr double kFarAway = 4;
constexpr double kLargestCoordinate = 1e11;

double largest_coordinate(const Bounds& b) {
  return std::max({std::abs(b.min.x), std::abs(b.min.y), std::abs(b.min.z), std::abs(b.max.x),
                   std::abs(b.max.y), std::abs(b.max.z)});
}

bool fits_float(Vec3 v) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return std::abs(v.x) <= kLargest && std::abs(v.y) <= kLargest && std::abs(v.z) <= kLargest;
}

// The middle one of up to a thousand edges.
double typical_edge(const std::vector<Vec3>& vertices, const std::vector<Mesh::Triangle>& all) {
  std::vector<double> edges;
  const std::size_t step = std::max<std::size_t>(1, all.size() / 1000);
  for (std::size_t i = 0; i < all.size(); i += step) {
    const double edge = length(vertices[all[i].b] - vertices[all[i].a]);
    if (edge > 0) edges.push_back(edge);
  }
  if (edges.empty()) return 0;
  const auto middle = edges.begin() + std::ptrdiff_t(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

}  // namespace

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3) {
    add_triangle(corners[0], corners[1], corners[2]);
  } else if (corners.size() > 3) {
    cut_ = triangulate(corners, vertices_, &work_, &triangles_) && cut_;
  }
}

Status MeshBuilder::check_extent(const Bounds& bounds) const {
  if (!(bounds.longest_side() > 0)) {
    return invalid_input(fmt::format("{}: all triangles lie in one point", path_));
  }
  const double reach = largest_coordinate(bounds);
  if (reach <= kLargestCoordinate) return {};
  return invalid_input(fmt::format("{}: reaches {:g} from the origin; it must be within 1e11",
                                   path_, reach, kLargestCoordinate));
}

void MeshBuilder::announce_lost_detail(const Bounds& bounds, Mesh* mesh) const {
  if (!single_precision_) return;
  const double reach = largest_coordinate(bounds);
  const double step = reach * std::numeric_limits<float>::epsilon() / 2;
  const double edge = typical_edge(vertices_, triangles_);
  if (step < 0.01 * edge) return;
  mesh->notes.push_back(
      fmt::format("{}: its 32-bit floats reach {:g}, where they step by {:.2g}, and its typical "
                  "edge is {:.2g}: "
                  "detail was lost when the file was written",
                  path_, reach, step, edge));
}

Status MeshBuilder::finish(Mesh* mesh) {
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec3 v = vertices_[i];
    if (fits_float(v)) continue;
    return invalid_input(
        fmt::format("{}: vertex {} is {:g},{:g},{:g}; it must be finite", path_, i, v.x, v.y, v.z));
  }
  if (!cut_) {
    return invalid_input(fmt::format(
        "{}: its concave polygons have too many corners to be cut into triangles", path_));
  }
  if (triangles_.empty()) return invalid_input(fmt::format("{}: holds no triangles", path_));
  Bounds bounds;
  for (const Mesh::Triangle& t : triangles_) {
    for (std::uint32_t index : {t.a, t.b, t.c}) bounds.add(vertices_[index]);
  }
  if (Status s = check_extent(bounds); !s.ok()) return s;
  Mesh result;
  announce_lost_detail(bounds, &result);
  if (largest_coordinate(bounds) > kFarAway * bounds.longest_side())
    result.origin = bounds.center();
  result.positions.reserve(vertices_.size());
  for (Vec3 v : vertices_) {
    const Vec3 p = v - result.origin;
    result.positions.push_back({float(p.x), float(p.y), float(p.z)});
  }
  result.triangles = std::move(triangles_);
  result.parts = {{0, result.triangles.size(), false}};
  result.scene_size = bounds_of(result).longest_side();
  *mesh = std::move(result);
  return {};
}

}  // namespace obscura::tools
