#ifndef OBSCURA_IO_MESHES_READ_GLTF_H_
#define OBSCURA_IO_MESHES_READ_GLTF_H_

#include <string>
#include <string_view>

#include "io/meshes/mesh_builder.h"

namespace obscura::tools {

// glTF 2.0, text or binary (GLB): the triangles of the default scene with the transforms of its
// nodes; positions as floats or quantized (KHR_mesh_quantization), sparse ones too. Skins, morph
// targets, materials and images are passed over. Buffers are read from the file itself, from data:
// URIs and from files in the same folder or below it. Extensions that are required and change
// geometry (Draco, meshopt) are refused by name. Everything is held against the bytes that are
// there. `path` is for messages and for finding buffers.
Status read_gltf(const std::string& path, std::string_view bytes, MeshBuilder* builder);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_READ_GLTF_H_
