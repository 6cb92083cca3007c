#include "obscura/camera.h"

#include <cmath>

#include "core/text.h"

namespace obscura {
namespace {

Camera square_pixels(bool orthographic, double height, int visible_width, int visible_height,
                     GuardBand guard_band) {
  Camera camera;
  camera.orthographic = orthographic;
  camera.scale_x = camera.scale_y = static_cast<float>(height / visible_height);
  camera.center_u = guard_band.left + 0.5f * static_cast<float>(visible_width);
  camera.center_v = guard_band.top + 0.5f * static_cast<float>(visible_height);
  return camera;
}

}  // namespace

Camera Camera::perspective(float fov_y, int visible_width, int visible_height,
                           GuardBand guard_band) {
  return square_pixels(false, 2 * std::tan(0.5 * fov_y), visible_width, visible_height, guard_band);
}

Camera Camera::perspective_sensor(float focal_length, float sensor_height, int visible_width,
                                  int visible_height, GuardBand guard_band) {
  return square_pixels(false, static_cast<double>(sensor_height) / focal_length, visible_width,
                       visible_height, guard_band);
}

Camera Camera::orthographic_height(float height, int visible_width, int visible_height,
                                   GuardBand guard_band) {
  return square_pixels(true, height, visible_width, visible_height, guard_band);
}

Status Camera::from_projection(const double m[16], int visible_width, int visible_height,
                               GuardBand guard_band, Camera* camera) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i])) {
      return invalid_input(text("projection entry ", i, " is ", m[i], "; it must be finite"));
    }
  }
  const bool perspective = m[14] != 0 && m[15] == 0;
  const bool parallel = m[14] == 0 && m[15] != 0;
  if (!(perspective || parallel) || m[12] != 0 || m[13] != 0) {
    return invalid_input(
        text("projection has last row ", m[12], " ", m[13], " ", m[14], " ", m[15],
             "; it must be 0 0 -1 0 (perspective) or 0 0 0 1 (parallel), row-major "
             "for column vectors"));
  }
  // ndc = (m0 x + m2 z + m3) / w with w = -z (perspective) or 1 (parallel).
  const double w = perspective ? -m[14] : m[15];
  const double sx = m[0] / w, sy = m[5] / w;
  if (!(sx > 0) || sy == 0 || !(perspective ? w > 0 : true)) {
    return invalid_input(text("projection scales x by ", sx, " and y by ", sy,
                              "; the view must not be mirrored or flat"));
  }
  // A negative y scale is Vulkan's flipped clip space; rows of the image still run downwards.
  const double flip = sy < 0 ? -1 : 1;
  const double shift_x = (perspective ? -m[2] : m[3]) / w;
  const double shift_y = flip * (perspective ? -m[6] : m[7]) / w;
  camera->orthographic = parallel;
  camera->scale_x = static_cast<float>(2 / (sx * visible_width));
  camera->scale_y = static_cast<float>(2 / (flip * sy * visible_height));
  // ndc = 0 at the middle of the visible part; the axis is where x = 0.
  camera->center_u = static_cast<float>(guard_band.left + 0.5 * visible_width * (1 + shift_x));
  camera->center_v = static_cast<float>(guard_band.top + 0.5 * visible_height * (1 - shift_y));
  return {};
}

}  // namespace obscura
