#ifndef OBSCURA_IO_MESHES_MESH_H_
#define OBSCURA_IO_MESHES_MESH_H_

#include <cstdint>
#include <string>
#include <vector>

#include "io/meshes/vec3.h"

namespace obscura::tools {

// Geometry, y up unless a file says otherwise: triangles in parts, and exact spheres.
struct Mesh {
  struct Point {
    float x = 0, y = 0, z = 0;
  };
  struct Triangle {
    std::uint32_t a = 0, b = 0, c = 0;
  };
  // Consecutive triangles that belong together. A closed part is the oriented boundary of matter,
  // faces counterclockwise seen from outside; any other part is made of open sheets. Parts may
  // overlap each other.
  struct Part {
    std::size_t first = 0, count = 0;
    bool closed = false;
  };
  // The only surfaces with smooth normals: they are intersected exactly, so that the normal is
  // that of the geometry. Everything else has its triangles' own normals. Always solid.
  struct Sphere {
    Vec3 center;
    double radius = 0;
  };

  std::vector<Point> positions;
  std::vector<Triangle> triangles;
  std::vector<Part> parts;  // cover all triangles in order
  std::vector<Sphere> spheres;
  double scene_size = 0;  // S: longest side of the bounding box, without an added ground
  // World position of the point that positions are relative to: floats keep their detail where the
  // world's coordinates are large (map projections, earth-centred frames).
  Vec3 origin;
  // What the user should know of the file, a sentence each.
  std::vector<std::string> notes;

  Vec3 position(std::uint32_t index) const {
    const Point& p = positions[index];
    return {p.x, p.y, p.z};
  }
};

struct Bounds {
  Vec3 min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};

  void add(Vec3 p);
  Vec3 center() const { return (min + max) * 0.5; }
  double longest_side() const;
};
// Of everything that a triangle or a sphere uses.
Bounds bounds_of(const Mesh& mesh);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_MESH_H_
