#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_PLANE_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_PLANE_H_

#include "obscura/occluder.h"
#include "screen/far_field/phase_image.h"
#include "view/geometry.h"

namespace obscura::far_field {

// What receivers are, visible part.
struct ReceiverImages {
  PhaseImage lattice;    // as Plane::lattice
  PhaseImage normal[3];  // u, v, w; w > 0 points away
};

// What slices are added to, visible part; which channel is what: see SliceSums.
inline constexpr int kMaxChannels = 8;
struct SumImages {
  PhaseImage channel[kMaxChannels];

  void clear(int channel, int width, int height, int phases, Executor& executor);
};

// The depth image as the passes see it, in one of two orientations: as it is, or transposed. Lines
// that run mostly down the image use the first, lines that run mostly across it the second, so that
// in both, pixels beside each other in a row meet the same interval of neighbouring lines, and no
// pass needs a gather.
//
// Coordinates: u along a row, v from row to row, texel centres at whole numbers, and the camera's
// axis at (center_u, center_v). The eye-space point at depth d is
// ((u - center_u) scale_u d, (v - center_v) scale_v d, d), without d in the first two where view
// rays are parallel; so the third axis points away from the camera.
struct Plane {
  int width = 0, height = 0;
  int left = 0, top = 0, visible_width = 0, visible_height = 0;
  float scale_u = 0, scale_v = 0, center_u = 0, center_v = 0;
  bool orthographic = false;

  // What is interpolated between texels: 1/depth, or for parallel rays depth; 0 on the background
  // and in the margin.
  PhaseImage lattice;

  // Finite occluders: the depth at which each texel's matter ends; 0 on the background.
  bool finite = false;
  PhaseImage back;

  ReceiverImages receivers;
  SumImages sums;
};

// Fills the plane's views of matter from the geometry; `margin` is the plane's, in texels. Finite
// thickness is a length along the view ray.
void fill_plane(const view::Geometry& geometry, const Occluder& occluder, bool transposed,
                int margin, int phases, Executor& executor, Plane* plane);

// After fill_plane().
void fill_receivers(const view::Geometry& geometry, bool transposed, Executor& executor,
                    Plane* plane);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_PLANE_H_
