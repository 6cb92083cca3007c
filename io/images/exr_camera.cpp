#include "io/images/exr_camera.h"

#include <cmath>
#include <utility>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

using Matrix = ExrHeader::Matrix;

// C = A^-1 B by Gauss-Jordan elimination of [A | B]; false where A has no inverse.
bool solve(const Matrix& a_in, const Matrix& b_in, double c[4][4]) {
  double a[4][8];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      a[i][j] = a_in[i * 4 + j];
      a[i][j + 4] = b_in[i * 4 + j];
    }
  }
  for (int k = 0; k < 4; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 4; ++i) {
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    }
    if (!(std::abs(a[pivot][k]) > 1e-20)) return false;
    std::swap(a[k], a[pivot]);
    for (int i = 0; i < 4; ++i) {
      const double f = a[i][k] / a[k][k];
      for (int j = k; j < 8 && i != k; ++j) a[i][j] -= f * a[k][j];
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) c[i][j] = a[i][j + 4] / a[i][i];
  }
  return true;
}

}  // namespace

Status camera_from_exr(const std::string& path, const ExrHeader& header, const PixelWindow& window,
                       ExrCamera* camera) {
  const Matrix& to_ndc = *header.world_to_ndc;
  auto refuse = [&](const char* why) {
    return invalid_input(
        fmt::format("{}: the attributes worldToCamera and worldToNDC {}; give a camera, for "
                    "example with fov-y",
                    path, why));
  };
  for (const Matrix* m : {&*header.world_to_camera, &to_ndc}) {
    for (double v : *m) {
      if (!std::isfinite(v)) return refuse("hold values that are not finite");
    }
  }
  double c[4][4];  // camera space to NDC: (x, y, z, 1) C = (x', y', ., w')
  if (!solve(*header.world_to_camera, to_ndc, c)) return refuse("have no inverse");
  // w' is a multiple of depth, or constant: seen in the last column, which holds exact zeros then.
  double direction = 0;
  for (int i : {3, 7, 11}) direction = std::max(direction, std::abs(to_ndc[i]));
  const bool perspective = direction > 1e-9 * std::abs(to_ndc[15]);
  const double w = perspective ? std::abs(c[2][3]) : c[3][3];
  if (w == 0) return refuse("do not make a camera");
  const double slope_x = c[0][0] / w, slope_y = c[1][1] / w;
  double axis_x = perspective ? c[2][0] / c[2][3] : c[3][0] / w;
  double axis_y = perspective ? c[2][1] / c[2][3] : c[3][1] / w;
  if (!(slope_x > 0) || slope_y == 0 || !std::isfinite(slope_x + slope_y + axis_x + axis_y)) {
    return refuse("do not make a camera");
  }
  // What is left must be nothing: x alone moves x', y alone y'. Rows 0 to 2 come from the matrices'
  // linear parts, in which single precision loses little.
  const bool sheared = std::abs(c[1][0]) > 1e-3 * slope_x * w ||
                       std::abs(c[0][1]) > 1e-3 * std::abs(slope_y) * w ||
                       (perspective && std::max(std::abs(c[0][3]), std::abs(c[1][3])) > 1e-3 * w);
  if (sheared) return refuse("make a rolled or sheared view");
  double scale_x = slope_x, scale_y = -slope_y;
  if (slope_y > 0) {
    scale_x = slope_x / 2;
    scale_y = slope_y / 2;
    axis_x = (axis_x + 1) / 2;
    axis_y = (1 - axis_y) / 2;
  }
  const PixelWindow& d = header.display_window;
  camera->camera.orthographic = !perspective;
  camera->camera.scale_x = static_cast<float>(1 / (scale_x * d.width()));
  camera->camera.scale_y = static_cast<float>(1 / (scale_y * d.height()));
  camera->camera.center_u = static_cast<float>(d.min_x - window.min_x + axis_x * d.width());
  camera->camera.center_v = static_cast<float>(d.min_y - window.min_y + axis_y * d.height());
  // A parallel view does not show its direction; OpenEXR's own is meant.
  camera->looks_along_plus_z = !perspective || c[2][3] > 0;
  return {};
}

void normals_to_eye_space(const Matrix& m, bool looks_along_plus_z, DepthInput* input) {
  // The inverse transpose is the matrix of cofactors over the determinant, of which the sign
  // suffices for a direction.
  double k[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      k[i][j] = m[a * 4 + c] * m[b * 4 + d] - m[a * 4 + d] * m[b * 4 + c];
    }
  }
  const double determinant = m[0] * k[0][0] + m[1] * k[0][1] + m[2] * k[0][2];
  const double sign = determinant < 0 ? -1 : 1;
  const double sign_z = looks_along_plus_z ? -sign : sign;
  for (std::size_t i = 0; i < input->normal_x.size(); ++i) {
    const double x = input->normal_x[i], y = input->normal_y[i], z = input->normal_z[i];
    auto component = [&](int j) { return x * k[0][j] + y * k[1][j] + z * k[2][j]; };
    input->normal_x[i] = static_cast<float>(sign * component(0));
    input->normal_y[i] = static_cast<float>(sign * component(1));
    input->normal_z[i] = static_cast<float>(sign_z * component(2));
  }
}

}  // namespace obscura::tools
