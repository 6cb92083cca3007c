#ifndef OBSCURA_APPS_OBSCURA_INPUT_H_
#define OBSCURA_APPS_OBSCURA_INPUT_H_

#include <string>

#include "apps/obscura/option_table.h"
#include "io/sequences/camera_list.h"
#include "scene/scenes/load_scene.h"

namespace obscura::app {

// A depth field, and the geometry behind it where the input was a scene or a mesh.
struct LoadedInput {
  tools::Rendering rendering;  // of a depth image: its G-buffer only, the scene is null
  NormalUse normal_use = NormalUse::kAuto;

  const tools::DepthInput& depth() const { return rendering.gbuffer; }
  DepthField field() const;
};

// What a method wants rendered beside depth and normals.
struct LayerNeeds {
  bool back_depth = false;
  int layers = 0;
  bool given = false;  // whatever layers a file has
};

// INPUT and the options that say what it is: a depth image, a mesh or a procedural scene.
class InputOptions {
 public:
  void add_to(CLI::App* command);

  const std::string& path() const { return path_; }

  // Loads a file or renders a scene or mesh on `threads` threads.
  Status load(const LayerNeeds& needs, int threads, LoadedInput* input) const {
    return load(path_, nullptr, needs, threads, input);
  }
  // The same for a file of a sequence; `projection`, its camera, may be null.
  Status load(const std::string& path, const tools::ProjectionMatrix* projection,
              const LayerNeeds& needs, int threads, LoadedInput* input) const;

 private:
  Status render(const std::string& path, const LayerNeeds& needs, int threads,
                LoadedInput* input) const;

  std::string path_;
  OptionTable table_;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_INPUT_H_
