#include "io/meshes/write_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/images/atomic_file.h"

namespace obscura::tools {
namespace {

template <class T>
void append(std::string* bytes, T value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Status write_ply(const std::string& path, const Mesh& mesh, const VertexValues& values) {
  const Vec3 o = mesh.origin;
  const bool wide = o.x != 0 || o.y != 0 || o.z != 0;
  const std::string_view real = wide ? "double" : "float";
  std::string bytes = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\n"
      "property {} z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float visibility\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      std::endian::native == std::endian::little ? "little" : "big", mesh.positions.size(), real,
      real, real, mesh.triangles.size());
  bytes.reserve(bytes.size() + mesh.positions.size() * 43 + mesh.triangles.size() * 13);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Mesh::Point& p = mesh.positions[i];
    if (wide) {
      for (const double v : {p.x + o.x, p.y + o.y, p.z + o.z}) append(&bytes, v);
    } else {
      for (const float v : {p.x, p.y, p.z}) append(&bytes, v);
    }
    for (std::size_t k = 0; k < 3; ++k) append(&bytes, values.normals[3 * i + k]);
    const float visible = values.visibility[i];
    const auto grey = static_cast<char>(std::lround(255 * std::clamp(visible, 0.0F, 1.0F)));
    bytes.append(3, grey);
    append(&bytes, visible);
  }
  for (const Mesh::Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const std::uint32_t corner : {t.a, t.b, t.c}) append(&bytes, corner);
  }
  return write_text(path, bytes);
}

}  // namespace obscura::tools
