#ifndef OBSCURA_SCENE_VIEWS_VIEW_SPEC_H_
#define OBSCURA_SCENE_VIEWS_VIEW_SPEC_H_

#include <array>
#include <numbers>

#include "io/meshes/vec3.h"
#include "obscura/camera.h"

namespace obscura::tools {

// A camera in the world.
struct ViewSpec {
  int width = 640, height = 360;  // the visible part
  GuardBand guard_band{64, 64, 36, 36};
  Vec3 eye{0, 0, 1}, look_at{}, up{0, 1, 0};
  Vec3 origin;  // world position that eye and look_at are relative to (Mesh::origin)
  bool orthographic = false;
  double fov_y = std::numbers::pi / 3;  // radians, (0, pi), of the visible part
  double ortho_height = 1;              // world units, of the visible part

  int full_width() const { return width + guard_band.left + guard_band.right; }
  int full_height() const { return height + guard_band.top + guard_band.bottom; }
  Camera camera() const;
  // Eye space in the world: x right, y up, z against the line of sight.
  Frame frame() const;
};

// Eye space to world space, row-major, of a camera that turns its heading to the right, in radians,
// after its pitch upwards.
std::array<float, 9> world_from_eye(const Frame& frame, double heading, double pitch);

// Refuses sizes and angles out of range, an eye that is the point looked at, and a line of sight
// along `up`.
Status validate(const ViewSpec& view);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VIEWS_VIEW_SPEC_H_
