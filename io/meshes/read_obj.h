#ifndef OBSCURA_IO_MESHES_READ_OBJ_H_
#define OBSCURA_IO_MESHES_READ_OBJ_H_

#include <string>
#include <string_view>

#include "io/meshes/mesh_builder.h"

namespace obscura::tools {

// Wavefront OBJ: vertices (v) and faces (f) with absolute or relative indices, lines that go on
// behind a backslash; texture coordinates, normals, groups, materials, points, lines and curves are
// passed over. `path` is for messages.
Status read_obj(const std::string& path, std::string_view bytes, MeshBuilder* builder);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_READ_OBJ_H_
