#ifndef OBSCURA_SCENE_RAYS_GBUFFER_H_
#define OBSCURA_SCENE_RAYS_GBUFFER_H_

#include "io/images/depth_input.h"
#include "obscura/executor.h"
#include "scene/rays/ray_scene.h"
#include "scene/views/view_spec.h"

namespace obscura::tools {

// What to render beside depth and normals.
struct LayerSpec {
  int layers = 0;           // [0, 64] nearest intervals of matter along each pixel's ray
  bool back_depth = false;  // where the first of them ends
  // World length along the view ray that open sheets get; 0: 0.5 % of the scene size.
  double sheet_thickness = 0;
};

// Renders depth, eye-space normals and, where asked for, depth layers, with one ray through each
// pixel's exact centre, guard band included. Depth is linear, +inf where nothing is hit. Normals
// are those of the geometry (triangles flat, spheres smooth), turned to the camera.
//
// Layers are the intervals in which the ray is inside matter. Each closed part is entered and left
// by counting its crossings; an open sheet is matter from where it is hit for the sheet thickness;
// intervals that overlap or touch become one. Pixels with fewer layers hold +inf.
//
// Refuses a view that validate() refuses and an eye inside a solid. The same bits for any number
// of threads. Fills every field of `input` but its name.
Status render_gbuffer(const RayScene& scene, const ViewSpec& view, const LayerSpec& layers,
                      Executor& executor, DepthInput* input);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_RAYS_GBUFFER_H_
