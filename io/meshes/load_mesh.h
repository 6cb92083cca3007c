#ifndef OBSCURA_IO_MESHES_LOAD_MESH_H_
#define OBSCURA_IO_MESHES_LOAD_MESH_H_

#include <string>

#include "io/meshes/mesh.h"
#include "obscura/status.h"

namespace obscura::tools {

// Whether a file name has a mesh's ending: .obj, .ply, .gltf, .glb, also with .gz behind it.
bool is_mesh(const std::string& path);

// Reads the triangles of a mesh file, larger polygons cut into triangles, node transforms applied;
// points and lines are left out. Parts are not yet known: all triangles are one part of sheets.
// A file that cannot be read, holds no triangle, or has coordinates that are not finite or indices
// out of range is refused with one sentence that names it.
Status load_mesh(const std::string& path, Mesh* mesh);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_LOAD_MESH_H_
