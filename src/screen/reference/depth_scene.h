#ifndef OBSCURA_SRC_SCREEN_REFERENCE_DEPTH_SCENE_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_DEPTH_SCENE_H_

#include <vector>

#include "core/aligned_image.h"
#include "obscura/occluder.h"
#include "screen/reference/rays.h"
#include "view/geometry.h"

namespace obscura {

// What rays are traced against, made from a depth field: the surface between texel centres for
// solid occluders, boxes of matter on whole texels for the others, and the pyramid over either.
// Keeps its memory from one build to the next.
class DepthScene {
 public:
  // `geometry` must outlive the use of trace(): layers stay where they are.
  void build(const view::Geometry& geometry, const Occluder& occluder, Executor& executor);

  // All but max_distance and beyond_border is set.
  const TraceScene& trace() const { return scene_; }

 private:
  void build_surface(const view::Geometry& geometry, Executor& executor);
  void build_boxes(const view::Geometry& geometry, const Occluder& occluder, Executor& executor);
  void size_pyramids(int count);
  void build_bounds(const view::Geometry& geometry, int layer, Executor& executor);
  template <class Choose>
  void build_upper_levels(int pyramid, Choose choose, Executor& executor);
  float* level(int pyramid, int l);

  TraceScene scene_;
  AlignedImage<float> heights_;  // surface
  AlignedImage<float> back_;     // thickness
  // Pyramids, laid out as TraceScene says: the surface's, or two for each layer of matter.
  std::vector<AlignedImage<float>> pyramids_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_DEPTH_SCENE_H_
