#include "io/meshes/read_obj.h"
#include "tests/fuzz/mesh_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return obscura::fuzz::check_mesh(obscura::tools::read_obj, "/nowhere/fuzz.obj", data, size);
}
