#ifndef OBSCURA_SCENE_SCENES_MESH_VIEW_H_
#define OBSCURA_SCENE_SCENES_MESH_VIEW_H_

#include <string>

#include "io/meshes/load_mesh.h"
#include "scene/scenes/load_scene.h"

namespace obscura::tools {

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

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_SCENES_MESH_VIEW_H_
