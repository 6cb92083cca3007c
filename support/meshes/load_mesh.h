#ifndef OBSCURA_SUPPORT_MESHES_LOAD_MESH_H_
#define OBSCURA_SUPPORT_MESHES_LOAD_MESH_H_

#include <string>

#include "support/scenes/load_scene.h"

namespace obscura::support {

// Whether a file name has a mesh's ending: .obj, .ply, .gltf, .glb, also with .gz behind it.
bool is_mesh(const std::string& path);

// Reads the triangles of a mesh file, larger polygons cut into triangles, node transforms applied;
// points and lines are left out. Parts are not yet known: all triangles are one part of sheets.
// A file that cannot be read, holds no triangle, or has coordinates that are not finite or indices
// out of range is refused with one sentence that names it.
Status load_mesh(const std::string& path, Mesh* mesh);

struct MeshOptions {
  ViewOptions view{};
  bool ground = false;
  bool sheets = false;
};
template <FieldsOf<MeshOptions> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.view, v);
  v(s.ground, Field{"ground", "", {}, "Put the mesh on a plane; it does not count in its size."});
  v(s.sheets,
    Field{
        "sheets", "", {}, "Take every surface for an open sheet, also those that bound a solid."});
}

// A view that frames the mesh: from the right, in front and above, at its bounding sphere. What
// `options` say of the camera is kept; the rest is chosen to fit.
ViewSpec framed_view(const Bounds& bounds, const ViewOptions& options);

// Loads a mesh, finds its solids (find_solids), frames it and renders it.
Status load_mesh(const std::string& path, const MeshOptions& options, Executor& executor,
                 Rendering* rendering);

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_MESHES_LOAD_MESH_H_
