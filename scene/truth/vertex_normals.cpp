#include "scene/truth/vertex_normals.h"

namespace obscura::tools {

std::vector<float> vertex_normals(const Mesh& mesh, std::size_t* without) {
  std::vector<Vec3> sums(mesh.positions.size());
  for (const Mesh::Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.position(t.a);
    const Vec3 area = cross(mesh.position(t.b) - a, mesh.position(t.c) - a);
    for (const std::uint32_t corner : {t.a, t.b, t.c}) sums[corner] = sums[corner] + area;
  }
  *without = 0;
  std::vector<float> normals;
  normals.reserve(3 * sums.size());
  for (const Vec3& sum : sums) {
    const bool has = length(sum) > 0;
    if (!has) ++*without;
    const Vec3 n = has ? sum / length(sum) : Vec3{0, 0, 1};
    for (const double v : {n.x, n.y, n.z}) normals.push_back(static_cast<float>(v));
  }
  return normals;
}

}  // namespace obscura::tools
