#include "io/meshes/load_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <new>

#include "io/meshes/gzip.h"

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

// What the importer says, without line breaks.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "not a mesh of its kind" : text;
}

// Indices are looked at before anything follows them: importers hand on what stands in the file.
Status check_faces(const std::string& path, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices == 0 || !face.mIndices) {
        return invalid_input(fmt::format("{}: face {} has no corners", path, i));
      }
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < mesh.mNumVertices) continue;
        return invalid_input(fmt::format("{}: face {} names vertex {} of {}", path, i,
                                         int(face.mIndices[k]), mesh.mNumVertices));
      }
    }
  }
  return {};
}

class Collector {
 public:
  Collector(const std::string& path, const aiScene& scene, Mesh* mesh)
      : path_(path), scene_(scene), mesh_(*mesh) {}

  Status collect() {
    add_node(*scene_.mRootNode, aiMatrix4x4());
    return status_;
  }

 private:
  void add_node(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes && status_.ok(); ++i) {
      add_mesh(*scene_.mMeshes[node.mMeshes[i]], transform);
    }
    for (unsigned i = 0; i < node.mNumChildren && status_.ok(); ++i) {
      add_node(*node.mChildren[i], transform);
    }
  }

  void add_mesh(const aiMesh& source, const aiMatrix4x4& transform) {
    const std::size_t first = mesh_.positions.size();
    if (first + source.mNumVertices > std::size_t(0xFFFFFFFF)) {
      status_ = unsupported(fmt::format("{}: has more than 2^32 vertices", path_));
      return;
    }
    const bool mirrored = transform.Determinant() < 0;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D p = transform * source.mVertices[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        status_ = invalid_input(fmt::format("{}: vertex {} is {:g},{:g},{:g}; it must be finite",
                                            path_, first + i, p.x, p.y, p.z));
        return;
      }
      mesh_.positions.push_back({p.x, p.y, p.z});
    }
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::uint32_t corners[3];
      for (int k = 0; k < 3; ++k) {
        corners[k] = std::uint32_t(first + face.mIndices[k]);
      }
      if (mirrored) std::swap(corners[1], corners[2]);
      mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    }
  }

  const std::string& path_;
  const aiScene& scene_;
  Mesh& mesh_;
  Status status_;
};

Status read(const std::string& path, Mesh* mesh) {
  bool zipped = false;
  const std::string ending = mesh_ending(path, &zipped);
  if (ending.empty()) {
    return invalid_input(fmt::format(
        "{}: is not a mesh by its ending; meshes are .obj, .ply, .gltf and .glb, also with .gz",
        path));
  }
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return invalid_input(fmt::format("{}: there is no such file", path));
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    return invalid_input(fmt::format("{}: is not a file", path));
  }
  if (std::filesystem::file_size(path, error) == 0) {
    return invalid_input(fmt::format("{}: is empty", path));
  }
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  if (zipped) {
    std::string contents;
    if (Status s = read_gzip(path, &contents); !s.ok()) return s;
    if (contents.empty()) return invalid_input(fmt::format("{}: is empty", path));
    scene = importer.ReadFileFromMemory(contents.data(), contents.size(), 0, ending.c_str());
  } else {
    scene = importer.ReadFile(path, 0);
  }
  if (!scene || !scene->mRootNode || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    return invalid_input(fmt::format("{}: {}", path, one_line(importer.GetErrorString())));
  }
  if (Status s = check_faces(path, *scene); !s.ok()) return s;
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene)
    return invalid_input(fmt::format("{}: {}", path, one_line(importer.GetErrorString())));
  Mesh result;
  if (Status s = Collector(path, *scene, &result).collect(); !s.ok()) return s;
  if (result.triangles.empty()) {
    return invalid_input(fmt::format("{}: holds no triangles", path));
  }
  result.parts = {{0, result.triangles.size(), false}};
  result.scene_size = bounds_of(result).longest_side();
  if (!(result.scene_size > 0)) {
    return invalid_input(fmt::format("{}: all triangles lie in one point", path));
  }
  const Bounds bounds = bounds_of(result);
  if (std::max(length(bounds.min), length(bounds.max)) > 1e11) {
    return invalid_input(fmt::format("{}: reaches {:g} from the origin; it must be within 1e11",
                                     path, std::max(length(bounds.min), length(bounds.max))));
  }
  *mesh = std::move(result);
  return {};
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
  } catch (const std::exception& e) {
    return invalid_input(fmt::format("{}: {}", path, one_line(e.what())));
  }
}

}  // namespace obscura::tools
