#include "io/images/depth_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "fmt/format.h"
#include "io/images/exr_camera.h"
#include "io/images/files.h"
#include "io/images/pfm.h"
#include "io/images/png.h"

namespace obscura::tools {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The visible size and the guard band of an image of `width` x `height` in all.
Status split_guard_band(const std::string& path, const GuardBandSpec& spec, DepthInput* input) {
  // In per cent, the whole number that GuardBandSpec::resolve would give for what is left visible.
  auto side = [&](int full, double n) {
    if (!spec.per_cent) return static_cast<int>(std::min(n, 65535.0));
    const int guess = static_cast<int>(std::round(full * n / (100 + 2 * n)));
    for (int px : {guess, guess - 1, guess + 1}) {
      if (std::round(n / 100 * (full - 2 * px)) == px) return px;
    }
    return guess;
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

bool positive(double v) { return v > 0 && std::isfinite(v); }

Status must_be_positive(const char* option, double v) {
  return invalid_argument(fmt::format("{} is {}; it must be in (0, inf)", option, v));
}

bool gives_camera(const DepthFileOptions& o) {
  return o.fov_y || o.ortho_height || o.focal_length || o.sensor_height || !o.projection.empty() ||
         o.projection_matrix;
}

// The camera that the options say.
Status set_camera(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  const GuardBand& g = input->guard_band;
  const int w = input->width - g.left - g.right, h = input->height - g.top - g.bottom;
  const bool lens = o.focal_length || o.sensor_height;
  const bool projection = o.projection_matrix || !o.projection.empty();
  const int given = o.fov_y.has_value() + o.ortho_height.has_value() + lens +
                    o.projection_matrix.has_value() + !o.projection.empty();
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
  } else if (projection) {
    double matrix[16];
    const std::string& source = o.projection_matrix ? path : o.projection;
    if (o.projection_matrix) {
      std::copy(o.projection_matrix->begin(), o.projection_matrix->end(), matrix);
    } else if (Status s = read_projection(o.projection, matrix); !s.ok()) {
      return s;
    }
    if (Status s = Camera::from_projection(matrix, w, h, g, &input->camera); !s.ok()) {
      return {s.code(), fmt::format("{}: {}", source, s.message())};
    }
    const bool ndc = o.depth_kind == DepthKind::kNdc || o.depth_kind == DepthKind::kNdcReversed;
    if (ndc && (!o.near || !o.far)) {
      double near, far;
      planes_of(matrix, o.depth_kind, &near, &far);
      if (!positive(near) || !(far > near)) {
        return invalid_input(
            fmt::format("{}: its planes, near {:.4g} and far {:.4g}, do not suit depth-kind {}; "
                        "choose the other kind, or give near and far",
                        source, near, far, enum_name(o.depth_kind)));
      }
      if (!o.near) input->near_plane = static_cast<float>(near);
      if (!o.far) input->far_plane = static_cast<float>(far);
    }
  } else {
    return invalid_argument(
        fmt::format("{} does not say what its camera is; give fov-y, "
                    "ortho-height, focal-length with sensor-height, or projection",
                    path));
  }
  return {};
}

// Lays a channel over the data window out over `whole`, NaN where the file has no pixel.
std::vector<float> over_whole(std::vector<float> values, const PixelWindow& data,
                              const PixelWindow& whole) {
  if (data == whole) return values;
  std::vector<float> out(static_cast<std::size_t>(whole.width()) * whole.height(), kNan);
  for (int y = data.min_y; y <= data.max_y; ++y) {
    const float* row = values.data() + static_cast<std::size_t>(y - data.min_y) * data.width();
    const std::size_t at = static_cast<std::size_t>(y - whole.min_y) * whole.width();
    std::copy_n(row, data.width(), out.begin() + at + data.min_x - whole.min_x);
  }
  return out;
}

// The display window is no more than a claim: a small file must not cost gigabytes.
Status check_whole_window(const std::string& path, const PixelWindow& data,
                          const PixelWindow& whole) {
  const double stored = static_cast<double>(data.width()) * data.height();
  const double covered = static_cast<double>(whole.width()) * whole.height();
  constexpr double kFreely = 1 << 25;
  if (whole.width() <= 65535 && whole.height() <= 65535 &&
      covered <= std::max(4 * stored, kFreely)) {
    return {};
  }
  return invalid_input(
      fmt::format("{}: its pixels are {}x{}, but with the display window it covers {}x{}", path,
                  data.width(), data.height(), whole.width(), whole.height()));
}

Status load_exr(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  ExrHeader header;
  if (Status s = read_exr_header(path, &header); !s.ok()) return s;
  ExrChannelChoice choice;
  if (Status s = choose_exr_channels(path, header, o, &choice); !s.ok()) return s;
  const bool normals = !choice.normals[0].empty();
  const bool world_normals = normals && o.normal_space == NormalSpace::kWorld;
  if (world_normals && !header.world_to_camera) {
    return invalid_input(fmt::format(
        "{}: world-space normals need the attribute worldToCamera, which it lacks", path));
  }
  std::vector<std::string> wanted{choice.depth};
  if (!choice.back_depth.empty()) wanted.push_back(choice.back_depth);
  if (normals) wanted.insert(wanted.end(), std::begin(choice.normals), std::end(choice.normals));
  auto layer_channel = [](int k, const char* end) { return fmt::format("layer{}.{}", k + 1, end); };
  int layers = 0;
  while (layers < o.layers && header.find(layer_channel(layers, "Z")) &&
         header.find(layer_channel(layers, "ZBack"))) {
    wanted.push_back(layer_channel(layers, "Z"));
    wanted.push_back(layer_channel(layers++, "ZBack"));
  }
  const PixelWindow whole = header.whole_window();
  if (Status s = check_whole_window(path, header.data_window, whole); !s.ok()) return s;
  Image image;
  if (Status s = read_exr(path, wanted, &header, &image); !s.ok()) return s;

  const PixelWindow& display = header.display_window;
  input->width = whole.width();
  input->height = whole.height();
  input->guard_band = {display.min_x - whole.min_x, whole.max_x - display.max_x,
                       display.min_y - whole.min_y, whole.max_y - display.max_y};
  auto take = [&](const std::string& name) {
    for (Image::Channel& c : image.channels) {
      if (c.name != name) continue;
      // A copy, since an option may name one channel twice.
      const auto uses = std::count(wanted.begin(), wanted.end(), name);
      return over_whole(uses > 1 ? c.values : std::move(c.values), header.data_window, whole);
    }
    return std::vector<float>();
  };
  input->depth = take(choice.depth);
  input->back_depth = take(choice.back_depth);
  input->normal_x = take(choice.normals[0]);
  input->normal_y = take(choice.normals[1]);
  input->normal_z = take(choice.normals[2]);
  for (int k = 0; k < layers; ++k) {
    input->layers.push_back({take(layer_channel(k, "Z")), take(layer_channel(k, "ZBack"))});
  }
  if (o.guard_band) {
    if (input->guard_band != GuardBand()) {
      return invalid_argument(fmt::format(
          "{}: its data window already gives a guard band; guard-band cannot be given too", path));
    }
    if (Status s = split_guard_band(path, *o.guard_band, input); !s.ok()) return s;
  }
  ExrCamera camera;
  const bool known = header.world_to_camera && header.world_to_ndc;
  Status derived;
  if (known) derived = camera_from_exr(path, header, whole, &camera);
  if (world_normals) {
    normals_to_eye_space(*header.world_to_camera, camera.looks_along_plus_z, input);
  }
  if (known && !gives_camera(o)) {
    input->camera = camera.camera;
    return derived;
  }
  return set_camera(path, o, input);
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
    if (status.ok()) status = set_camera(path, o, &loaded);
  } else {
    status = invalid_input(fmt::format(
        "{}: unknown kind of depth image; its ending must be .exr, .pfm or .png", path));
  }
  if (status.ok()) *input = std::move(loaded);
  return status;
}

}  // namespace obscura::tools

namespace obscura {

bool SettingText<std::optional<tools::GuardBandSpec>>::parse(
    std::string_view text, std::optional<tools::GuardBandSpec>* value) {
  tools::GuardBandSpec spec;
  if (!SettingText<tools::GuardBandSpec>::parse(text, &spec)) return false;
  *value = spec;
  return true;
}

std::string SettingText<std::optional<tools::GuardBandSpec>>::write(
    const std::optional<tools::GuardBandSpec>& value) {
  return value ? SettingText<tools::GuardBandSpec>::write(*value) : "";
}

}  // namespace obscura
