#include "scene/volumes/volume_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/volumes/volume_framing.h"

namespace obscura::tools {
namespace {

constexpr double kDefaultFov = 35;  // degrees
constexpr double kFilled = 0.84;    // share of the picture that the matter takes

Vec3 vec(const Double3& v) { return {v[0], v[1], v[2]}; }
Double3 array(Vec3 v) { return {v.x, v.y, v.z}; }
std::array<float, 3> floats(const Double3& v) { return {float(v[0]), float(v[1]), float(v[2])}; }

// From the matter towards the default camera: ahead of its front, a little aside and above; less
// above a patient, whose face shows.
Vec3 default_direction(const VolumeImage& image, Vec3 up) {
  const Vec3 front = std::abs(up.z) > std::abs(up.y) ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const double above = image.format.starts_with("NIfTI") ? 0.22 : 0.42;
  return normalize(front - up * dot(front, up) + 0.55 * cross(front, up) + above * up);
}

}  // namespace

Status place_camera(const VolumeImage& image, GridView<const float> distance,
                    const VolumeViewOptions& o, SurfaceCamera* camera, const RunOptions& run) {
  const bool orthographic = o.camera == Projection::kOrthographic || o.ortho_height;
  if (orthographic && o.fov_y) {
    return invalid_argument("fov-y does not apply to an orthographic camera; give ortho-height");
  }
  const double fov = o.fov_y.value_or(kDefaultFov);
  if (!(fov > 0 && fov < 179)) {
    return invalid_argument(fmt::format("fov-y is {}; it must be in (0, 179) degrees", fov));
  }
  if (o.ortho_height && !(*o.ortho_height > 0 && *o.ortho_height < 1e15)) {
    return invalid_argument(
        fmt::format("ortho-height is {}; it must be positive", *o.ortho_height));
  }
  const MatterOutline outline(image, distance, run);
  const Vec3 up = o.up.value_or(vec(image.up));
  if (!(length(up) > 0 && is_finite(up))) {
    return invalid_argument("up must be finite and not zero");
  }
  const Vec3 look_at = o.look_at.value_or(outline.middle());
  const Vec3 towards = o.eye ? *o.eye - look_at : default_direction(image, normalize(up));
  if (!(length(towards) > 0 && is_finite(towards))) {
    return invalid_argument("eye and look-at must be finite and apart");
  }
  const Vec3 forward = -normalize(towards);
  Vec3 right = cross(forward, normalize(up));
  if (length(right) < 1e-6) {
    if (o.up) return invalid_argument("up must not point along the view");
    right = cross(forward, std::abs(forward.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  }
  right = normalize(right);
  const Vec3 above = cross(right, forward);

  const double aspect = double(o.size.width) / o.size.height;
  const double slope = std::tan(fov * std::numbers::pi / 360);
  const ViewAxes axes{right, above, forward};
  Vec3 eye;
  double height = 0;
  if (orthographic) {
    const OrthographicFit fit = fit_orthographic(outline, axes, o.look_at, aspect, kFilled);
    eye = fit.eye;
    height = fit.height;
  } else {
    eye = fit_perspective(outline, axes, o.look_at, slope, aspect, kFilled);
  }
  if (o.eye) eye = *o.eye;
  SurfaceCamera result;
  result.eye = floats(image.to_grid(array(eye)));
  result.right = floats(image.direction_to_grid(array(right)));
  result.up = floats(image.direction_to_grid(array(above)));
  result.forward = floats(image.direction_to_grid(array(forward)));
  result.orthographic = orthographic;
  result.fov_y = float(fov * std::numbers::pi / 180);
  if (orthographic) result.ortho_height = float(o.ortho_height.value_or(height));
  *camera = result;
  return {};
}

}  // namespace obscura::tools
