#include "io/meshes/read_gltf.h"
#include "tests/fuzz/mesh_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return obscura::fuzz::check_mesh(obscura::tools::read_gltf, "/nowhere/fuzz.gltf", data, size);
}
