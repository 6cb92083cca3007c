#ifndef OBSCURA_IO_MESHES_WRITE_PLY_H_
#define OBSCURA_IO_MESHES_WRITE_PLY_H_

#include <span>
#include <string>

#include "io/meshes/mesh.h"
#include "obscura/status.h"

namespace obscura::tools {

// What is written beside the position of each vertex.
struct VertexValues {
  std::span<const float> visibility;  // one per vertex, in [0, 1]
  std::span<const float> normals;     // three per vertex
};

// Writes vertices and triangles as binary PLY: x y z, nx ny nz, red green blue (the visibility as a
// grey, 255 is open) and the visibility itself as a float. Positions are those of the world; where
// the mesh has an origin they are doubles, so that no detail is lost.
Status write_ply(const std::string& path, const Mesh& mesh, const VertexValues& values);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_WRITE_PLY_H_
