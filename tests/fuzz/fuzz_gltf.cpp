#include "io/meshes/read_gltf.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

using namespace obscura;

// A mesh that is read has finite corners and triangles of corners that are there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  tools::MeshBuilder builder("/nowhere/fuzz.gltf");
  if (!tools::read_gltf("/nowhere/fuzz.gltf", bytes, &builder).ok()) return 0;
  tools::Mesh mesh;
  if (!builder.finish(&mesh).ok()) return 0;
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
