#include "io/images/depth_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "fmt/format.h"
#include "io/images/files.h"

namespace obscura::tools {
namespace {

// Near and far planes of a perspective or parallel matrix whose depth runs from 0 to 1.
void planes_of(const double m[16], DepthKind kind, double* near, double* far) {
  const bool perspective = m[14] != 0;
  const double w = perspective ? -m[14] : m[15];
  // ndc = -a + b / d (perspective) or -a d + b (parallel).
  const double a = m[10] / w, b = m[11] / w;
  auto depth_at = [&](double ndc) { return perspective ? b / (ndc + a) : (b - ndc) / a; };
  const bool reversed = kind == DepthKind::kNdcReversed;
  *near = depth_at(reversed ? 1 : 0);
  *far = depth_at(reversed ? 0 : 1);
  if (!(std::abs(*far) < 1e30)) *far = std::numeric_limits<double>::infinity();
}

bool positive(double v) { return v > 0 && std::isfinite(v); }

Status must_be_positive(const char* option, double v) {
  return invalid_argument(fmt::format("{} is {}; it must be in (0, inf)", option, v));
}

// A matrix for column vectors has zeros below, but for one number; one for row vectors has them on
// the right. `m` is transposed where only the latter makes a camera.
bool looks_transposed(const double m[16]) {
  const bool below = m[12] != 0 || m[13] != 0, right = m[3] != 0 || m[7] != 0;
  const bool perspective = m[15] == 0;
  if (!perspective) return (below || m[14] != 0) && !right && m[11] == 0;
  // Depth becomes w unscaled: |m14| is 1, where a transposed matrix has it at m11.
  const bool unit_below = std::abs(std::abs(m[14]) - 1) < 1e-5;
  const bool unit_right = std::abs(std::abs(m[11]) - 1) < 1e-5;
  return unit_right && !unit_below;
}

// Turns a projection that looks along +z, so that it looks along -z as all do here.
bool turn_left_handed(double m[16]) {
  if (!(m[15] == 0 && m[14] > 0)) return false;
  for (const int i : {2, 6, 10, 14}) m[i] = -m[i];
  return true;
}

}  // namespace

Status read_matrix(const std::string& path, const char* what, double matrix[16]) {
  std::string text;
  if (Status s = read_bytes(path, &text, 1 << 16); !s.ok()) return s;
  for (char& c : text) {
    if (c == ',' || c == ';' || c == '[' || c == ']') c = ' ';
  }
  std::istringstream in(text);
  std::string word;
  int count = 0;
  for (; in >> word; ++count) {
    if (count == 16 || !parse_number(word, &matrix[count]) || !std::isfinite(matrix[count])) {
      count = -1;
      break;
    }
  }
  if (count == 9) {
    const double part[9] = {matrix[0], matrix[1], matrix[2], matrix[3], matrix[4],
                            matrix[5], matrix[6], matrix[7], matrix[8]};
    for (int i = 0; i < 16; ++i) {
      matrix[i] = i / 4 < 3 && i % 4 < 3 ? part[i / 4 * 3 + i % 4] : i == 15;
    }
    return {};
  }
  if (count == 16) return {};
  return invalid_input(fmt::format(
      "{}: {} holds exactly 16 numbers, all finite, row-major, for column vectors", path, what));
}

bool gives_camera(const DepthFileOptions& o) {
  return o.fov_y || o.ortho_height || o.focal_length || o.sensor_height || !o.projection.empty() ||
         o.intrinsics || o.projection_matrix;
}

Status set_camera(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  const GuardBand& g = input->guard_band;
  const int w = input->width - g.left - g.right, h = input->height - g.top - g.bottom;
  const bool lens = o.focal_length || o.sensor_height;
  const bool projection = o.projection_matrix || !o.projection.empty();
  const int given = o.fov_y.has_value() + o.ortho_height.has_value() + lens +
                    o.projection_matrix.has_value() + !o.projection.empty() +
                    o.intrinsics.has_value();
  if (given > 1) {
    return invalid_argument(
        "fov-y, ortho-height, focal-length with sensor-height, intrinsics and projection exclude "
        "each other");
  }
  if (o.fov_y) {
    if (!(*o.fov_y >= 1e-4 && *o.fov_y <= 179.9)) {
      return invalid_argument(
          fmt::format("fov-y is {}; it must be in [0.0001, 179.9] degrees", *o.fov_y));
    }
    input->camera =
        Camera::perspective(static_cast<float>(*o.fov_y * std::numbers::pi / 180), w, h, g);
  } else if (o.ortho_height) {
    if (!positive(*o.ortho_height)) return must_be_positive("ortho-height", *o.ortho_height);
    input->camera = Camera::orthographic_height(static_cast<float>(*o.ortho_height), w, h, g);
  } else if (lens) {
    if (!o.focal_length || !o.sensor_height) {
      return invalid_argument("focal-length and sensor-height must be given together");
    }
    if (!positive(*o.focal_length)) return must_be_positive("focal-length", *o.focal_length);
    if (!positive(*o.sensor_height)) return must_be_positive("sensor-height", *o.sensor_height);
    input->camera = Camera::perspective_sensor(static_cast<float>(*o.focal_length),
                                               static_cast<float>(*o.sensor_height), w, h, g);
  } else if (o.intrinsics) {
    const Intrinsics& k = *o.intrinsics;
    if (!positive(k.fx) || !positive(k.fy)) {
      return invalid_argument(fmt::format(
          "intrinsics have focal lengths {:g} and {:g}; both must be in (0, inf) pixels", k.fx,
          k.fy));
    }
    Camera camera;
    camera.scale_x = static_cast<float>(1 / k.fx);
    camera.scale_y = static_cast<float>(1 / k.fy);
    camera.center_u = static_cast<float>(g.left + k.cx);
    camera.center_v = static_cast<float>(g.top + k.cy);
    input->camera = camera;
  } else if (projection) {
    double matrix[16];
    const std::string& source = o.projection_matrix ? path : o.projection;
    if (o.projection_matrix) {
      std::copy(o.projection_matrix->begin(), o.projection_matrix->end(), matrix);
    } else if (Status s = read_matrix(source, "a projection file", matrix); !s.ok()) {
      return s;
    }
    if (looks_transposed(matrix)) {
      return invalid_input(
          fmt::format("{}: the matrix looks transposed: it is for row vectors, and must be for "
                      "column vectors, with last row 0 0 -1 0 (perspective) or 0 0 0 1 (parallel)",
                      source));
    }
    if (turn_left_handed(matrix)) {
      input->notes.push_back(
          fmt::format("{}: a left-handed projection, which looks along +z: turned round", source));
    }
    if (Status s = Camera::from_projection(matrix, w, h, g, &input->camera); !s.ok()) {
      return {s.code(), fmt::format("{}: {}", source, s.message())};
    }
    const DepthKind kind = input->depth_kind;
    const bool ndc = kind == DepthKind::kNdc || kind == DepthKind::kNdcReversed;
    if (ndc && matrix[10] == 0 && (matrix[11] == 0 || matrix[15] != 0)) {
      return invalid_input(fmt::format(
          "{}: its third row maps no depth, which depth-kind {} needs; give near and far and "
          "another camera, such as fov-y",
          source, enum_name(kind)));
    }
    if (ndc && (!o.near || !o.far)) {
      double near, far;
      planes_of(matrix, kind, &near, &far);
      if (!positive(near) || !(far > near)) {
        return invalid_input(
            fmt::format("{}: its planes, near {:.4g} and far {:.4g}, do not suit depth-kind {}; "
                        "choose the other kind, or give near and far",
                        source, near, far, enum_name(kind)));
      }
      if (!o.near) input->near_plane = static_cast<float>(near);
      if (!o.far) input->far_plane = static_cast<float>(far);
    }
  } else {
    return invalid_argument(
        fmt::format("{} does not say what its camera is; give fov-y, "
                    "ortho-height, focal-length with sensor-height, intrinsics or projection",
                    path));
  }
  return {};
}

}  // namespace obscura::tools
