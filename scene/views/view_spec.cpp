#include "scene/views/view_spec.h"

#include <fmt/format.h>

#include <cmath>

namespace obscura::tools {
namespace {

std::string to_text(Vec3 v) { return fmt::format("{:g},{:g},{:g}", v.x, v.y, v.z); }

// World units; Embree refuses rays near the square root of the largest float.
constexpr double kFarthest = 1e12;

}  // namespace

Camera ViewSpec::camera() const {
  return orthographic ? Camera::orthographic_height(float(ortho_height), width, height, guard_band)
                      : Camera::perspective(float(fov_y), width, height, guard_band);
}

Frame ViewSpec::frame() const {
  const Vec3 z = normalize(eye - look_at);
  const Vec3 x = normalize(cross(up, z));
  return {x, cross(z, x), z};
}

std::array<float, 9> world_from_eye(const Frame& frame, double heading, double pitch) {
  const Vec3 axes[3] = {
      {1, 0, 0}, {0, std::cos(pitch), std::sin(pitch)}, {0, -std::sin(pitch), std::cos(pitch)}};
  std::array<float, 9> m;
  for (int column = 0; column < 3; ++column) {
    const Vec3 v = frame.to_world(axes[column]);
    m[column] = float(std::cos(heading) * v.x - std::sin(heading) * v.z);
    m[3 + column] = float(v.y);
    m[6 + column] = float(std::sin(heading) * v.x + std::cos(heading) * v.z);
  }
  return m;
}

Status validate(const ViewSpec& v) {
  const GuardBand& g = v.guard_band;
  if (v.width < 1 || v.height < 1) {
    return invalid_argument(
        fmt::format("size is {}x{}; both sides must be at least 1", v.width, v.height));
  }
  for (int side : {g.left, g.right, g.top, g.bottom}) {
    if (side < 0 || side > 65535) {
      return invalid_argument(fmt::format("guard is {}; it must be in [0, 65535]", side));
    }
  }
  if (v.width > 65535 || v.height > 65535 || v.full_width() > 65535 || v.full_height() > 65535) {
    return invalid_argument(
        fmt::format("size with guard band is {}x{}; each side must be in [1, 65535]",
                    v.full_width(), v.full_height()));
  }
  // 4 GiB of depth and normals.
  if (double(v.full_width()) * v.full_height() > double(1 << 28)) {
    return invalid_argument(
        fmt::format("size with guard band is {}x{}; it must be at most 2^28 pixels", v.full_width(),
                    v.full_height()));
  }
  if (!is_finite(v.eye))
    return invalid_argument("eye is " + to_text(v.eye) + "; it must be finite");
  if (!is_finite(v.look_at)) {
    return invalid_argument("look-at is " + to_text(v.look_at) + "; it must be finite");
  }
  if (!is_finite(v.up) || length(v.up) == 0) {
    return invalid_argument("up is " + to_text(v.up) + "; it must be finite and not zero");
  }
  if (length(v.eye) > kFarthest || length(v.look_at) > kFarthest) {
    return invalid_argument("eye is " + to_text(v.eye + v.origin) + " and look-at " +
                            to_text(v.look_at + v.origin) +
                            "; both must be within 1e12 of the origin");
  }
  const Vec3 sight = v.look_at - v.eye;
  if (!(length(sight) > 0)) {
    return invalid_argument("eye and look-at are both " + to_text(v.eye + v.origin) +
                            "; they must differ");
  }
  if (!(length(cross(normalize(sight), normalize(v.up))) > 1e-6)) {
    return invalid_argument("the line of sight from eye " + to_text(v.eye + v.origin) +
                            " to look-at " + to_text(v.look_at + v.origin) + " is along up " +
                            to_text(v.up) + "; give another up");
  }
  constexpr double kDegree = std::numbers::pi / 180;
  if (!v.orthographic && !(v.fov_y > 0.0099 * kDegree && v.fov_y < 179.91 * kDegree)) {
    return invalid_argument(
        fmt::format("fov-y is {:g} degrees; it must be in [0.01, 179.9]", v.fov_y / kDegree));
  }
  if (v.orthographic && !(v.ortho_height > 0 && v.ortho_height <= kFarthest)) {
    return invalid_argument(
        fmt::format("ortho-height is {:g}; it must be in (0, 1e12]", v.ortho_height));
  }
  return {};
}

}  // namespace obscura::tools
