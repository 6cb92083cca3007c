#ifndef OBSCURA_REPRODUCE_SWEEP_SCENE_H_
#define OBSCURA_REPRODUCE_SWEEP_SCENE_H_

#include <string>
#include <vector>

#include "io/images/image.h"
#include "io/volumes/volume_image.h"

namespace obscura::tools {

// A volume with its distances and the points of its surface that an orthographic view sees.
struct SweepScene {
  VolumeImage image;
  std::vector<float> distance;
  std::array<float, 3> view{};  // unit direction away from the eye, grid space
  int side = 0;                 // pixels
  std::vector<SurfacePoint> points;
  std::vector<int> pixels;  // of the points, row by row

  GridView<const float> grid() const {
    const VolumeView v = image.view();
    return {distance.data(), v.size, v.spacing};
  }
  // Values of the points as a picture; white elsewhere.
  Image picture(const std::vector<float>& values) const;
};

struct SweepSource {
  std::string spec;
  float offset = 0;  // of the isovalue, from the volume's own or Otsu's
  int every = 1;     // planes along z kept of so many, which makes spacing unequal
};

// Loads a volume, sweeps distances, and traces the view.
Status load_sweep_scene(const SweepSource& source, int side, const RunOptions& run,
                        SweepScene* scene);

}  // namespace obscura::tools

#endif  // OBSCURA_REPRODUCE_SWEEP_SCENE_H_
