#ifndef OBSCURA_APPS_OBSCURA_INPUT_H_
#define OBSCURA_APPS_OBSCURA_INPUT_H_

#include <memory>
#include <string>

#include "apps/obscura/option_table.h"
#include "support/depth_input.h"
#include "support/rays/ray_scene.h"
#include "support/rays/view_spec.h"

namespace obscura::app {

// A depth field, and the geometry behind it where the input was a scene or a mesh.
struct LoadedInput {
  support::DepthInput depth;
  NormalUse normal_use = NormalUse::kAuto;
  std::shared_ptr<const support::RayScene> scene;  // null for depth images
  support::ViewSpec view;                          // of scenes and meshes
};

// What a method wants rendered beside depth and normals.
struct LayerNeeds {
  bool back_depth = false;
  int layers = 0;
};

// INPUT and the options that say what it is: a depth image, a mesh or a procedural scene.
class InputOptions {
 public:
  void add_to(CLI::App* command);

  const std::string& path() const { return path_; }

  // Loads a file or renders a scene or mesh on `threads` threads.
  Status load(const LayerNeeds& needs, int threads, LoadedInput* input) const;

 private:
  std::string path_;
  OptionTable table_;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_INPUT_H_
