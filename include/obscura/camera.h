#ifndef OBSCURA_CAMERA_H_
#define OBSCURA_CAMERA_H_

#include "obscura/export.h"
#include "obscura/status.h"
#include "obscura/views.h"

namespace obscura {

// Pixels around the visible image that hold geometry but receive no result.
struct GuardBand {
  int left = 0, right = 0, top = 0, bottom = 0;

  static GuardBand symmetric(int x, int y) { return {x, x, y, y}; }
  // The visible size of an image that is `whole` with its guard band.
  Extent inside(Extent whole) const {
    return {whole.width - left - right, whole.height - top - bottom};
  }
  bool operator==(const GuardBand&) const = default;
};

// Maps pixels of a depth image to eye space: right-handed, x right, y up, camera at the origin
// looking along -z, depth = -z. Pixel centres are at half-integers, row 0 is the top row, and
// pixel coordinates (u, v) count from the corner of the whole image, guard band included:
//   perspective   x = (u - center_u) scale_x depth,  y = (center_v - v) scale_y depth
//   orthographic  x = (u - center_u) scale_x,        y = (center_v - v) scale_y
struct OBSCURA_API Camera {
  bool orthographic = false;
  float scale_x = 0;   // (0, inf); eye-space width of a pixel at depth 1, or in world units
  float scale_y = 0;   // (0, inf); the same for its height
  float center_u = 0;  // pixel coordinates of the optical axis; off-centre views are free to
  float center_v = 0;  // put it anywhere, outside the image too

  // Symmetric view; `fov_y` in (0, pi) radians is that of the visible part, pixels are square.
  static Camera perspective(float fov_y, int visible_width, int visible_height,
                            GuardBand guard_band = {});

  // From a lens: focal length and sensor height in the same unit.
  static Camera perspective_sensor(float focal_length, float sensor_height, int visible_width,
                                   int visible_height, GuardBand guard_band = {});

  // Symmetric parallel view; `height` in world units is that of the visible part.
  static Camera orthographic_height(float height, int visible_width, int visible_height,
                                    GuardBand guard_band = {});

  // From a projection matrix of the visible part: 16 numbers, row-major, for column vectors;
  // perspective (last row 0 0 -1 0, off-centre too) or parallel (last row 0 0 0 1).
  static Status from_projection(const double matrix[16], int visible_width, int visible_height,
                                GuardBand guard_band, Camera* camera);

  bool operator==(const Camera&) const = default;
};

}  // namespace obscura

#endif  // OBSCURA_CAMERA_H_
