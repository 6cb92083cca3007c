#ifndef OBSCURA_TESTS_FUZZ_MESH_CHECKS_H_
#define OBSCURA_TESTS_FUZZ_MESH_CHECKS_H_

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/meshes/mesh_builder.h"

namespace obscura::fuzz {

// Reads a mesh by read(name, bytes, builder). One that is read has finite corners and triangles of
// corners that are there.
template <class Read>
int check_mesh(Read read, const char* name, const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  tools::MeshBuilder builder(name);
  tools::Mesh mesh;
  if (!read(name, bytes, &builder).ok() || !builder.finish(&mesh).ok()) return 0;
  for (const auto& v : mesh.positions) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) std::abort();
  }
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t corner : {t.a, t.b, t.c}) {
      if (corner >= mesh.positions.size()) std::abort();
    }
  }
  return 0;
}

}  // namespace obscura::fuzz

#endif  // OBSCURA_TESTS_FUZZ_MESH_CHECKS_H_
