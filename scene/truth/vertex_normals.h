#ifndef OBSCURA_SCENE_TRUTH_VERTEX_NORMALS_H_
#define OBSCURA_SCENE_TRUTH_VERTEX_NORMALS_H_

#include <vector>

#include "io/meshes/mesh.h"

namespace obscura::tools {

// Three numbers per vertex: the mean of the normals of its triangles by area, counterclockwise seen
// from outside, of length 1. (0, 0, 1) where a vertex has no triangle with an area; `without`
// counts those.
std::vector<float> vertex_normals(const Mesh& mesh, std::size_t* without);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_VERTEX_NORMALS_H_
