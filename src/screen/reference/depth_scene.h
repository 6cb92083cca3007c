#ifndef OBSCURA_SRC_SCREEN_REFERENCE_DEPTH_SCENE_H_
#define OBSCURA_SRC_SCREEN_REFERENCE_DEPTH_SCENE_H_

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
  void size_pyramid();
  void build_upper_levels(Executor& executor);
  float* level(AlignedImage<float>* pyramid, int l) const;

  TraceScene scene_;
  AlignedImage<float> heights_;  // surface
  AlignedImage<float> back_;     // thickness
  AlignedImage<float> highest_;  // one row: see TraceScene
  AlignedImage<float> lowest_;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_REFERENCE_DEPTH_SCENE_H_
