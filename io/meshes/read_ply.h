#ifndef OBSCURA_IO_MESHES_READ_PLY_H_
#define OBSCURA_IO_MESHES_READ_PLY_H_

#include <string>
#include <string_view>

#include "io/meshes/mesh_builder.h"

namespace obscura::tools {

// Stanford PLY: ascii, binary little or big endian; polygons (vertex_indices, vertex_index) and
// triangle strips; every other element and property is passed over. Whatever the header promises is
// held against the bytes that are there before room is made for it. `path` is for messages.
Status read_ply(const std::string& path, std::string_view bytes, MeshBuilder* builder);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_READ_PLY_H_
