#ifndef OBSCURA_IO_IMAGES_DEPTH_INPUT_H_
#define OBSCURA_IO_IMAGES_DEPTH_INPUT_H_

#include <string>
#include <vector>

#include "obscura/depth_field.h"

namespace obscura::tools {

// A depth field that owns its pixels: what files, procedural scenes and meshes all become.
struct DepthInput {
  struct Layer {
    std::vector<float> front, back;
  };

  std::string name;  // the file or scene:... it came from, for messages
  int width = 0, height = 0;
  std::vector<float> depth;                         // width * height
  std::vector<float> normal_x, normal_y, normal_z;  // empty, or width * height each
  std::vector<float> back_depth;                    // empty, or width * height
  std::vector<Layer> layers;
  DepthKind depth_kind = DepthKind::kLinear;
  float near_plane = 0;
  float far_plane = std::numeric_limits<float>::infinity();
  Camera camera;
  GuardBand guard_band;
  std::vector<std::string> notes;  // what was found and done on reading, a line each
  double scene_size = 0;           // S of the conventions, world units; 0 where unknown

  // Views of the above; valid while this object lives and is not changed.
  DepthField field() const;

 private:
  mutable std::vector<DepthLayer> layer_views_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_DEPTH_INPUT_H_
