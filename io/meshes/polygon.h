#ifndef OBSCURA_IO_MESHES_POLYGON_H_
#define OBSCURA_IO_MESHES_POLYGON_H_

#include <cstdint>
#include <span>
#include <vector>

#include "io/meshes/mesh.h"

namespace obscura::tools {

// Cuts a polygon of four or more corners into triangles that wind the same way. Convex polygons are
// fans; others lose one ear after the other (Meisters 1975), seen along the polygon's mean normal.
// Of polygons that cross themselves something near is made. The time that ears take grows with the
// square of the corners and more: `work` falls by the points looked at, and false is returned where
// it would fall below 0.
bool triangulate(std::span<const std::uint32_t> corners, std::span<const Vec3> vertices,
                 std::int64_t* work, std::vector<Mesh::Triangle>* triangles);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_POLYGON_H_
