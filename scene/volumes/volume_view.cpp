#include "scene/volumes/volume_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura::tools {
namespace {

constexpr double kDefaultFov = 35;  // degrees
constexpr double kFilled = 0.92;    // share of the picture that the matter may take

Vec3 vec(const Double3& v) { return {v[0], v[1], v[2]}; }
Double3 array(Vec3 v) { return {v.x, v.y, v.z}; }
std::array<float, 3> floats(const Double3& v) { return {float(v[0]), float(v[1]), float(v[2])}; }

// World corners of the box of matter; of the whole volume where there is none.
std::array<Vec3, 8> matter_corners(const VolumeImage& image, GridView<const float> distance) {
  std::array<int, 3> first = image.size, last = {-1, -1, -1};
  const auto stride = distance.strides();
  for (int z = 0; z < image.size[2]; ++z) {
    for (int y = 0; y < image.size[1]; ++y) {
      const float* row = distance.data + y * stride[1] + z * stride[2];
      for (int x = 0; x < image.size[0]; ++x) {
        if (!(row[x * stride[0]] <= 0)) continue;
        const int at[3] = {x, y, z};
        for (int a = 0; a < 3; ++a) {
          first[a] = std::min(first[a], at[a]);
          last[a] = std::max(last[a], at[a]);
        }
      }
    }
  }
  if (last[0] < 0) {
    first = {0, 0, 0};
    for (int a = 0; a < 3; ++a) last[a] = image.size[a] - 1;
  }
  const Double3 h = image.spacing();
  std::array<Vec3, 8> corners;
  for (int c = 0; c < 8; ++c) {
    Double3 p;
    for (int a = 0; a < 3; ++a) {
      p[a] = (c >> a & 1 ? std::min(last[a] + 1, image.size[a] - 1) : std::max(first[a] - 1, 0)) *
             h[a];
    }
    corners[c] = vec(image.to_world(p));
  }
  return corners;
}

// From the matter towards the default camera: ahead of its front, a little aside and above.
Vec3 default_direction(Vec3 up) {
  const Vec3 front = std::abs(up.z) > std::abs(up.y) ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return normalize(front - up * dot(front, up) + 0.55 * cross(front, up) + 0.45 * up);
}

}  // namespace

Status place_camera(const VolumeImage& image, GridView<const float> distance,
                    const VolumeViewOptions& o, SurfaceCamera* camera) {
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
  const auto corners = matter_corners(image, distance);
  Vec3 middle;
  for (Vec3 c : corners) middle += c / 8;
  const Vec3 up = o.up.value_or(vec(image.up));
  if (!(length(up) > 0 && is_finite(up))) {
    return invalid_argument("up must be finite and not zero");
  }
  const Vec3 look_at = o.look_at.value_or(middle);
  const Vec3 towards =
      o.eye ? *o.eye - look_at : default_direction(normalize(up)) * length(corners[7] - corners[0]);
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

  // The least distance, or height, at which every corner is in the picture.
  const double aspect = double(o.size.width) / o.size.height;
  const double slope = std::tan(fov * std::numbers::pi / 360) * kFilled;
  double away = 0, height = 0, reach = 0;
  for (Vec3 c : corners) {
    const Vec3 d = c - look_at;
    const double lateral = std::max(std::abs(dot(d, above)), std::abs(dot(d, right)) / aspect);
    away = std::max(away, lateral / slope - dot(d, forward));
    height = std::max(height, 2 * lateral / kFilled);
    reach = std::max(reach, length(d));
  }
  SurfaceCamera result;
  const Vec3 eye =
      o.eye.value_or(look_at - forward * (orthographic ? 2 * reach : std::max(away, 1e-9)));
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
