#include "scene/views/gbuffer_file.h"

#include "fmt/format.h"
#include "io/images/exr.h"
#include "io/images/files.h"

namespace obscura::tools {
namespace {

using Matrix = ExrHeader::Matrix;

// Row vectors, p' = p M; camera space is left-handed with z forward.
Matrix world_to_camera(const ViewSpec& view) {
  const Frame f = view.frame();
  const Vec3 e = view.eye + view.origin;
  return {f.x.x, f.y.x, -f.z.x, 0, f.x.y,        f.y.y,        -f.z.y,      0,
          f.x.z, f.y.z, -f.z.z, 0, -dot(f.x, e), -dot(f.y, e), dot(f.z, e), 1};
}

// (0, 0) at the upper left corner of the display window, (1, 1) at its lower right corner.
Matrix camera_to_ndc(const Camera& c, const GuardBand& g, int width, int height) {
  const double sx = 1 / (double{c.scale_x} * width), sy = -1 / (double{c.scale_y} * height);
  const double x = (c.center_u - g.left) / width, y = (c.center_v - g.top) / height;
  if (c.orthographic) return {sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, 1, 0, x, y, 0, 1};
  return {sx, 0, 0, 0, 0, sy, 0, 0, x, y, 1, 1, 0, 0, 0, 0};
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) m[i * 4 + j] += a[i * 4 + k] * b[k * 4 + j];
    }
  }
  return m;
}

}  // namespace

Status write_gbuffer(const std::string& path, const DepthInput& input, const ViewSpec& view,
                     bool half_normals, const std::string& made_by) {
  if (file_ending(path) != ".exr") {
    return invalid_argument(fmt::format("'{}' cannot hold a G-buffer; it must end in .exr", path));
  }
  Image image(input.width, input.height);
  auto add = [&](const std::string& name, const std::vector<float>& values) {
    if (!values.empty()) image.add(name) = values;
  };
  add("Z", input.depth);
  add("ZBack", input.back_depth);
  add("N.X", input.normal_x);
  add("N.Y", input.normal_y);
  add("N.Z", input.normal_z);
  for (std::size_t k = 0; k < input.layers.size(); ++k) {
    add(fmt::format("layer{}.Z", k + 1), input.layers[k].front);
    add(fmt::format("layer{}.ZBack", k + 1), input.layers[k].back);
  }
  const GuardBand& g = input.guard_band;
  const int width = input.width - g.left - g.right, height = input.height - g.top - g.bottom;
  ExrWriteOptions options;
  options.made_by = made_by;
  options.display_window = PixelWindow{0, 0, width - 1, height - 1};
  options.data_window = PixelWindow{-g.left, -g.top, width + g.right - 1, height + g.bottom - 1};
  options.world_to_camera = world_to_camera(view);
  options.world_to_ndc =
      product(*options.world_to_camera, camera_to_ndc(input.camera, g, width, height));
  if (half_normals) options.types = {{"N.X", "half"}, {"N.Y", "half"}, {"N.Z", "half"}};
  return write_atomically(
      path, [&](const std::string& temporary) { return write_exr(temporary, image, options); });
}

}  // namespace obscura::tools
