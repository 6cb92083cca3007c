#ifndef OBSCURA_SCENE_SCENES_LOAD_SCENE_H_
#define OBSCURA_SCENE_SCENES_LOAD_SCENE_H_

#include <memory>
#include <string>

#include "io/images/depth_input.h"
#include "obscura/executor.h"
#include "scene/rays/ray_scene.h"
#include "scene/views/view_options.h"

namespace obscura::tools {

// Geometry, a view of it and what a renderer sees from there.
struct Rendering {
  std::shared_ptr<const RayScene> scene;
  ViewSpec view;
  DepthInput gbuffer;
};

// Whether `spec` names a procedural scene: "scene:...".
bool is_scene(const std::string& spec);

// Builds and renders `scene:NAME[?key=value&...]`. Keys are those of ViewOptions, `seed` and the
// scene's own (docs/scenes.md); they are laid over `options`. An unknown scene or key, a key given
// twice or a bad value is refused with one sentence that says what is possible.
Status load_scene(const std::string& spec, const ViewOptions& options, Executor& executor,
                  Rendering* rendering);

// The same with default options and all processors, if only the pixels are needed.
Status load_scene(const std::string& spec, DepthInput* input);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_SCENES_LOAD_SCENE_H_
