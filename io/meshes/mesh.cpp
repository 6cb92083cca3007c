#include "io/meshes/mesh.h"

#include <algorithm>

namespace obscura::tools {

void Bounds::add(Vec3 p) {
  min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
  max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
}

double Bounds::longest_side() const {
  const Vec3 d = max - min;
  return std::max({d.x, d.y, d.z});
}

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  for (const Mesh::Triangle& t : mesh.triangles) {
    for (std::uint32_t index : {t.a, t.b, t.c}) bounds.add(mesh.position(index));
  }
  for (const Mesh::Sphere& s : mesh.spheres) {
    const Vec3 r{s.radius, s.radius, s.radius};
    bounds.add(s.center - r);
    bounds.add(s.center + r);
  }
  return bounds;
}

}  // namespace obscura::tools
