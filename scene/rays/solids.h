#ifndef OBSCURA_SCENE_RAYS_SOLIDS_H_
#define OBSCURA_SCENE_RAYS_SOLIDS_H_

#include "io/meshes/mesh.h"

namespace obscura::tools {

// Volume that triangles [first, first + count) enclose; positive where they face outward.
double signed_volume(const Mesh& mesh, std::size_t first, std::size_t count);

// Splits a mesh into connected components and decides which of them are solids. Vertices in
// exactly the same place are one; triangles that share an edge are in one component. A component
// is a solid if along each of its edges as many triangles run one way as the other, so that they
// bound a volume, and if they face out of that volume. All other components become one part of
// open sheets: also a room whose walls face inward, and a sheet drawn from both sides. Triangles
// are reordered, part by part; those that repeat a vertex are dropped.
void find_solids(Mesh* mesh);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_RAYS_SOLIDS_H_
