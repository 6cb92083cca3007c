#include "io/meshes/load_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <new>

#include "io/meshes/file_bytes.h"
#include "io/meshes/read_gltf.h"
#include "io/meshes/read_obj.h"
#include "io/meshes/read_ply.h"

namespace obscura::tools {
namespace {

constexpr std::string_view kEndings[] = {"obj", "ply", "gltf", "glb"};

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

// "obj" for model.OBJ and model.obj.gz; "" if the file is no mesh.
std::string mesh_ending(const std::string& path, bool* zipped) {
  std::filesystem::path name(path);
  std::string ending = lower_ending(name);
  *zipped = ending == "gz";
  if (*zipped) ending = lower_ending(name.stem());
  const bool known =
      std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
  return known ? ending : "";
}

Status read(const std::string& path, Mesh* mesh) {
  bool zipped = false;
  const std::string ending = mesh_ending(path, &zipped);
  if (ending.empty()) {
    return invalid_input(fmt::format(
        "{}: is not a mesh by its ending; meshes are .obj, .ply, .gltf and .glb, also with .gz",
        path));
  }
  std::string bytes;
  if (Status s = read_file_bytes(path, &bytes); !s.ok()) return s;
  if (zipped) {
    const std::string compressed = std::move(bytes);
    if (Status s = inflate_gzip(path, compressed, &bytes); !s.ok()) return s;
  }
  MeshBuilder builder(path);
  const auto reader = ending == "obj" ? read_obj : ending == "ply" ? read_ply : read_gltf;
  if (Status s = reader(path, bytes, &builder); !s.ok()) return s;
  return builder.finish(mesh);
}

}  // namespace

bool is_mesh(const std::string& path) {
  bool zipped;
  return !mesh_ending(path, &zipped).empty();
}

Status load_mesh(const std::string& path, Mesh* mesh) {
  try {
    return read(path, mesh);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, fmt::format("{}: out of memory while reading it", path)};
  }
}

}  // namespace obscura::tools
