#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_PLANE_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_PLANE_H_

#include "core/aligned_image.h"
#include "obscura/occluder.h"
#include "view/geometry.h"

namespace obscura::far_field {

// A float image with a margin of zeros to the left and right of each row.
class MarginImage {
 public:
  void resize(int width, int height, int margin);
  float* row(int y) { return image_.row(y) + margin_; }
  const float* row(int y) const { return image_.row(y) + margin_; }
  std::ptrdiff_t stride() const { return image_.stride(); }
  int margin() const { return margin_; }
  std::size_t bytes() const { return sizeof(float) * image_.stride() * image_.height(); }

 private:
  AlignedImage<float> image_;
  int margin_ = 0;
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

  // What the contract interpolates between texels: 1/depth, or for parallel rays kappa - depth;
  // 0 on the background and in the margin.
  MarginImage lattice;
  float kappa = 0;

  // Finite occluders: the depth at which each texel's matter ends; 0 on the background.
  bool finite = false;
  MarginImage back;

  AlignedImage<float> normal_u, normal_v, normal_w;  // visible part; normal_w > 0 points away
  AlignedImage<float> obscurance;                    // visible part; sums of w_k times slices
};

// Fills the plane from the geometry; `margin` is the plane's, in texels. Finite thickness is a
// length along the view ray.
void fill_plane(const view::Geometry& geometry, const Occluder& occluder, bool transposed,
                int margin, Executor& executor, Plane* plane);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_PLANE_H_
