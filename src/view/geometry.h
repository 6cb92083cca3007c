#ifndef OBSCURA_SRC_VIEW_GEOMETRY_H_
#define OBSCURA_SRC_VIEW_GEOMETRY_H_

#include <vector>

#include "core/aligned_image.h"
#include "obscura/depth_field.h"
#include "obscura/executor.h"
#include "obscura/occluder.h"

namespace obscura::view {

// A converted DepthField, the only form that estimators see: positive linear depth with +inf for
// background, unit eye-space normals as three images, the same padding in all images.
struct Geometry {
  struct Layer {
    AlignedImage<float> front, back;  // linear depth; front = +inf: no matter; back >= front
  };

  int width = 0, height = 0;  // whole image, guard band included
  GuardBand guard_band;
  Camera camera;
  AlignedImage<float> depth;
  bool has_normals = false;
  // +z towards the camera; (0, 0, 1) on the background. Filled in the visible part only.
  AlignedImage<float> normal_x, normal_y, normal_z;
  AlignedImage<float> back_depth;      // when asked for; >= depth
  AlignedImage<float> runs;            // what back_from_widths() works in
  std::vector<Layer> layers;           // when asked for
  float min_depth = 0, max_depth = 0;  // over finite pixels; both 0 where all is background

  Extent visible() const { return guard_band.inside({width, height}); }
};

// What an estimator needs in addition to depth.
struct Needs {
  bool normals = false;
  bool back_depth = false;
  int layers = 0;
  // The occluder `auto`: layers where they are given and `any_layers` is set, else back_depth,
  // which comes from the back depth given, the first layer's, or the widths of what is seen.
  bool automatic = false, any_layers = false;
  bool works_without_normals = false;  // NormalUse::kNone is allowed

  // Adds what an occluder needs; `layers`: the method takes them for `auto`.
  Needs& with(const Occluder& occluder, bool layers);
};

// Checks a depth field and converts it, reusing the storage of `geometry`.
Status convert(const DepthField& field, const Needs& needs, Executor& executor, Geometry* geometry);

// Of `depth`.
void find_depth_range(Executor& executor, Geometry* geometry);

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_GEOMETRY_H_
