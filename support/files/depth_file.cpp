#include "support/files/depth_file.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "fmt/format.h"
#include "support/files/files.h"
#include "support/files/pfm.h"
#include "support/files/png.h"

namespace obscura::support {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The visible size and the guard band of an image of `width` x `height` in all.
Status split_guard_band(const std::string& path, const GuardBandSpec& spec, DepthInput* input) {
  auto side = [&](int full, double n) {
    return static_cast<int>(spec.per_cent ? std::round(full * n / (100 + 2 * n)) : n);
  };
  const int x = side(input->width, spec.x), y = side(input->height, spec.y);
  if (2 * x >= input->width || 2 * y >= input->height) {
    return invalid_input(fmt::format("{}: a guard band of {},{} px leaves nothing visible of {}x{}",
                                     path, x, y, input->width, input->height));
  }
  input->guard_band = GuardBand::symmetric(x, y);
  return {};
}

Status read_projection(const std::string& path, double matrix[16]) {
  std::string text;
  if (Status s = read_bytes(path, &text, 1 << 16); !s.ok()) return s;
  for (char& c : text) {
    if (c == ',' || c == ';' || c == '[' || c == ']') c = ' ';
  }
  std::istringstream in(text);
  std::string word;
  int count = 0;
  for (; in >> word; ++count) {
    if (count == 16 || !parse_number(word, &matrix[count])) {
      count = -1;
      break;
    }
  }
  if (count == 16) return {};
  return invalid_input(fmt::format(
      "{}: a projection file holds exactly 16 numbers, row-major, for column vectors", path));
}

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

// From the matrices of an EXR header: camera space (left-handed, z forward) to NDC.
Status camera_from_exr(const std::string& path, const ExrHeader& header, DepthInput* input) {
  const auto& to_camera = *header.world_to_camera;
  const auto& to_ndc = *header.world_to_ndc;
  auto refuse = [&] {
    return invalid_input(
        fmt::format("{}: the attributes worldToCamera and worldToNDC do not make a "
                    "camera; give one, for example with fov-y",
                    path));
  };
  // C = W^-1 M by Gauss-Jordan elimination of [W | M].
  double a[4][8];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      a[i][j] = to_camera[i * 4 + j];
      a[i][j + 4] = to_ndc[i * 4 + j];
    }
  }
  for (int k = 0; k < 4; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 4; ++i) {
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    }
    if (!(std::abs(a[pivot][k]) > 1e-20)) return refuse();
    std::swap(a[k], a[pivot]);
    for (int i = 0; i < 4; ++i) {
      const double f = a[i][k] / a[k][k];
      for (int j = k; j < 8 && i != k; ++j) a[i][j] -= f * a[k][j];
    }
  }
  double c[4][4];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) c[i][j] = a[i][j + 4] / a[i][i];
  }
  // Row vectors: (x, y, z, 1) C = (x', y', ., w'), with w' = z k or constant.
  const bool perspective = std::abs(c[2][3]) > 1e-12 * std::abs(c[3][3]) && c[2][3] != 0;
  const double w = perspective ? c[2][3] : c[3][3];
  const double slope_x = c[0][0] / w, slope_y = c[1][1] / w;
  double at_axis_x = (perspective ? c[2][0] : c[3][0]) / w;
  double at_axis_y = (perspective ? c[2][1] : c[3][1]) / w;
  if (!(slope_x > 0) || slope_y == 0 || !std::isfinite(slope_x + slope_y + at_axis_x + at_axis_y)) {
    return refuse();
  }
  // The standard has (0, 0) at the upper left and (1, 1) at the lower right corner of the display
  // window; several renderers write [-1, 1] with y up instead, which shows in the sign of y.
  double scale_x = slope_x, scale_y = -slope_y;
  if (slope_y > 0) {
    scale_x = slope_x / 2;
    scale_y = slope_y / 2;
    at_axis_x = (at_axis_x + 1) / 2;
    at_axis_y = (1 - at_axis_y) / 2;
  }
  const double width = header.display_window.width(), height = header.display_window.height();
  const GuardBand& g = input->guard_band;
  input->camera.orthographic = !perspective;
  input->camera.scale_x = static_cast<float>(1 / (scale_x * width));
  input->camera.scale_y = static_cast<float>(1 / (scale_y * height));
  input->camera.center_u = static_cast<float>(g.left + at_axis_x * width);
  input->camera.center_v = static_cast<float>(g.top + at_axis_y * height);
  return {};
}

bool positive(double v) { return v > 0 && std::isfinite(v); }

Status set_camera(const std::string& path, const DepthFileOptions& o, const ExrHeader* header,
                  DepthInput* input) {
  const GuardBand& g = input->guard_band;
  const int w = input->width - g.left - g.right, h = input->height - g.top - g.bottom;
  const bool lens = o.focal_length || o.sensor_height;
  const int given = o.fov_y.has_value() + o.ortho_height.has_value() + lens + !o.projection.empty();
  if (given > 1) {
    return invalid_argument(
        "fov-y, ortho-height, focal-length with sensor-height, and projection exclude each other");
  }
  if (o.fov_y) {
    if (!(*o.fov_y > 0 && *o.fov_y < 180)) {
      return invalid_argument(fmt::format("fov-y is {}; it must be in (0, 180) degrees", *o.fov_y));
    }
    input->camera =
        Camera::perspective(static_cast<float>(*o.fov_y * std::numbers::pi / 180), w, h, g);
  } else if (o.ortho_height) {
    input->camera = Camera::orthographic_height(static_cast<float>(*o.ortho_height), w, h, g);
  } else if (lens) {
    if (!o.focal_length || !o.sensor_height) {
      return invalid_argument("focal-length and sensor-height must be given together");
    }
    input->camera = Camera::perspective_sensor(static_cast<float>(*o.focal_length),
                                               static_cast<float>(*o.sensor_height), w, h, g);
  } else if (!o.projection.empty()) {
    double matrix[16];
    if (Status s = read_projection(o.projection, matrix); !s.ok()) return s;
    if (Status s = Camera::from_projection(matrix, w, h, g, &input->camera); !s.ok()) {
      return {s.code(), fmt::format("{}: {}", o.projection, s.message())};
    }
    const bool ndc = o.depth_kind == DepthKind::kNdc || o.depth_kind == DepthKind::kNdcReversed;
    if (ndc && !o.near && !o.far) {
      double near, far;
      planes_of(matrix, o.depth_kind, &near, &far);
      if (!positive(near) || !(far > near)) {
        return invalid_input(
            fmt::format("{}: its planes, near {:.4g} and far {:.4g}, are none; give "
                        "near and far",
                        o.projection, near, far));
      }
      input->near_plane = static_cast<float>(near);
      input->far_plane = static_cast<float>(far);
    }
  } else if (header && header->world_to_camera && header->world_to_ndc) {
    return camera_from_exr(path, *header, input);
  } else {
    return invalid_argument(
        fmt::format("{} does not say what its camera is; give fov-y, "
                    "ortho-height, focal-length with sensor-height, or projection",
                    path));
  }
  return {};
}

// Cuts or pads a channel over the data window to what DepthInput covers: at least the display
// window, NaN where the file has no pixel.
std::vector<float> over_input(const std::vector<float>& values, const PixelWindow& data,
                              const PixelWindow& whole) {
  if (data == whole) return values;
  std::vector<float> out(static_cast<std::size_t>(whole.width()) * whole.height(), kNan);
  for (int y = data.min_y; y <= data.max_y; ++y) {
    for (int x = data.min_x; x <= data.max_x; ++x) {
      out[static_cast<std::size_t>(y - whole.min_y) * whole.width() + x - whole.min_x] =
          values[static_cast<std::size_t>(y - data.min_y) * data.width() + x - data.min_x];
    }
  }
  return out;
}

// World normals to eye space by the inverse transpose of worldToCamera's linear part, which for
// its cofactors needs no division; camera space has z forward, eye space backward.
void to_eye_space(const ExrHeader::Matrix& m, DepthInput* input) {
  double k[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      k[i][j] = m[a * 4 + c] * m[b * 4 + d] - m[a * 4 + d] * m[b * 4 + c];
    }
  }
  const double determinant = m[0] * k[0][0] + m[1] * k[0][1] + m[2] * k[0][2];
  const double sign = determinant < 0 ? -1 : 1;
  for (std::size_t i = 0; i < input->normal_x.size(); ++i) {
    const double x = input->normal_x[i], y = input->normal_y[i], z = input->normal_z[i];
    auto component = [&](int j) {
      return static_cast<float>(sign * (x * k[0][j] + y * k[1][j] + z * k[2][j]));
    };
    input->normal_x[i] = component(0);
    input->normal_y[i] = component(1);
    input->normal_z[i] = -component(2);
  }
}

Status load_exr(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  ExrHeader header;
  if (Status s = read_exr_header(path, &header); !s.ok()) return s;
  ExrChannelChoice choice;
  if (Status s = choose_exr_channels(path, header, o, &choice); !s.ok()) return s;
  const bool normals = !choice.normals[0].empty();
  if (normals && o.normal_space == NormalSpace::kWorld && !header.world_to_camera) {
    return invalid_input(fmt::format(
        "{}: world-space normals need the attribute worldToCamera, which it lacks", path));
  }
  std::vector<std::string> wanted{choice.depth};
  if (!choice.back_depth.empty()) wanted.push_back(choice.back_depth);
  if (normals) wanted.insert(wanted.end(), std::begin(choice.normals), std::end(choice.normals));
  Image image;
  if (Status s = read_exr(path, wanted, &header, &image); !s.ok()) return s;

  const PixelWindow &data = header.data_window, &display = header.display_window;
  const PixelWindow whole{std::min(data.min_x, display.min_x), std::min(data.min_y, display.min_y),
                          std::max(data.max_x, display.max_x), std::max(data.max_y, display.max_y)};
  if (whole.width() > 65535 || whole.height() > 65535) {
    return invalid_input(fmt::format("{}: data and display window lie too far apart", path));
  }
  input->width = whole.width();
  input->height = whole.height();
  input->guard_band = {display.min_x - whole.min_x, whole.max_x - display.max_x,
                       display.min_y - whole.min_y, whole.max_y - display.max_y};
  auto take = [&](const std::string& name) {
    return name.empty() ? std::vector<float>() : over_input(image.find(name)->values, data, whole);
  };
  input->depth = take(choice.depth);
  input->back_depth = take(choice.back_depth);
  input->normal_x = take(choice.normals[0]);
  input->normal_y = take(choice.normals[1]);
  input->normal_z = take(choice.normals[2]);
  if (normals && o.normal_space == NormalSpace::kWorld)
    to_eye_space(*header.world_to_camera, input);
  if (o.guard_band) {
    if (input->guard_band != GuardBand()) {
      return invalid_argument(fmt::format(
          "{}: its data window already gives a guard band; guard-band cannot be given too", path));
    }
    if (Status s = split_guard_band(path, *o.guard_band, input); !s.ok()) return s;
  }
  return set_camera(path, o, &header, input);
}

Status check_exr_only(const std::string& path, const DepthFileOptions& o) {
  const char* option = !o.depth_channel.empty()                     ? "depth-channel"
                       : !o.back_depth_channel.empty()              ? "back-depth-channel"
                       : o.normals != "auto" && o.normals != "none" ? "normals"
                                                                    : nullptr;
  if (!option) return {};
  return invalid_argument(
      fmt::format("{} is not an EXR file; {} names channels of one", path, option));
}

Status load_pfm(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  if (Status s = check_exr_only(path, o); !s.ok()) return s;
  std::string bytes;
  if (Status s = read_bytes(path, &bytes); !s.ok()) return s;
  Image image;
  if (Status s = decode_pfm(bytes, path, &image); !s.ok()) return s;
  if (image.channels.size() != 1) {
    return invalid_input(fmt::format("{}: a depth image has 1 channel, not 3", path));
  }
  input->width = image.width;
  input->height = image.height;
  input->depth = std::move(image.channels[0].values);
  return {};
}

// PNG: near + v / 65535 (far - near), or NDC as it is; 65535 is background.
Status load_png(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  if (Status s = check_exr_only(path, o); !s.ok()) return s;
  std::string bytes;
  if (Status s = read_bytes(path, &bytes); !s.ok()) return s;
  Image image;
  bool sixteen_bits = false;
  if (Status s = decode_png(bytes, path, &image, &sixteen_bits); !s.ok()) return s;
  if (!sixteen_bits || image.channels.size() != 1) {
    return invalid_input(
        fmt::format("{}: a PNG depth image must be grey with 16 bits per pixel", path));
  }
  input->width = image.width;
  input->height = image.height;
  input->depth = std::move(image.channels[0].values);
  const bool ndc = o.depth_kind == DepthKind::kNdc || o.depth_kind == DepthKind::kNdcReversed;
  if (ndc) return {};
  if (!o.near || !o.far || !(*o.far > *o.near) || !std::isfinite(*o.far)) {
    return invalid_argument(
        fmt::format("{}: a PNG depth image needs near and far, with near < far < inf", path));
  }
  for (float& v : input->depth) {
    v = v >= 1 ? kNan : static_cast<float>(*o.near + v * (*o.far - *o.near));
  }
  return {};
}

}  // namespace

Status load_depth_input(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  const std::string ending = file_ending(path);
  DepthInput loaded;
  loaded.name = path;
  loaded.depth_kind = o.depth_kind;
  if (o.near) loaded.near_plane = static_cast<float>(*o.near);
  if (o.far) loaded.far_plane = static_cast<float>(*o.far);
  Status status;
  if (ending == ".exr") {
    status = load_exr(path, o, &loaded);
  } else if (ending == ".pfm" || ending == ".png") {
    status = ending == ".pfm" ? load_pfm(path, o, &loaded) : load_png(path, o, &loaded);
    if (status.ok() && o.guard_band) status = split_guard_band(path, *o.guard_band, &loaded);
    if (status.ok()) status = set_camera(path, o, nullptr, &loaded);
  } else {
    status = invalid_input(fmt::format(
        "{}: unknown kind of depth image; its ending must be .exr, .pfm or .png", path));
  }
  if (status.ok()) *input = std::move(loaded);
  return status;
}

}  // namespace obscura::support

namespace obscura {

bool SettingText<std::optional<support::GuardBandSpec>>::parse(
    std::string_view text, std::optional<support::GuardBandSpec>* value) {
  support::GuardBandSpec spec;
  if (!SettingText<support::GuardBandSpec>::parse(text, &spec)) return false;
  *value = spec;
  return true;
}

std::string SettingText<std::optional<support::GuardBandSpec>>::write(
    const std::optional<support::GuardBandSpec>& value) {
  return value ? SettingText<support::GuardBandSpec>::write(*value) : "";
}

}  // namespace obscura
