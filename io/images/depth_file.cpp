#include "io/images/depth_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fmt/format.h"
#include "io/images/background.h"
#include "io/images/depth_camera.h"
#include "io/images/exr_camera.h"
#include "io/images/files.h"
#include "io/images/normal_check.h"
#include "io/images/pfm.h"
#include "io/images/png.h"

namespace obscura::tools {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

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

// Stored values to depth: what means nothing, unit and kind.
Status settle_depth(const DepthFileOptions& o, bool half_floats, DepthInput* input) {
  const bool metric =
      o.depth_kind == FileDepthKind::kLinear || o.depth_kind == FileDepthKind::kDistance;
  const NothingThere nothing{o.background, o.invalid, metric, half_floats};
  if (Status s = settle_background(nothing, input); !s.ok()) return s;
  if (o.depth_scale && !metric) {
    return invalid_argument(
        fmt::format("depth-scale is for depth-kind linear and distance; depth-kind {} has no unit",
                    enum_name(o.depth_kind)));
  }
  auto change = [&](auto f) {
    for (float& v : input->depth) v = static_cast<float>(f(v));
    for (float& v : input->back_depth) v = static_cast<float>(f(v));
    for (DepthInput::Layer& layer : input->layers) {
      for (float& v : layer.front) v = static_cast<float>(f(v));
      for (float& v : layer.back) v = static_cast<float>(f(v));
    }
  };
  if (o.depth_scale) change([&](double v) { return v * *o.depth_scale; });
  if (o.depth_kind == FileDepthKind::kInverse) {
    change([](double v) { return v > 0 ? 1 / v : kInf; });
  } else if (o.depth_kind == FileDepthKind::kLogarithmic) {
    if (!o.far || !std::isfinite(*o.far)) {
      return invalid_argument("depth-kind logarithmic needs far, the camera's far plane");
    }
    const double full = std::log2(1 + *o.far);
    change([&](double v) { return v < 1 ? std::exp2(v * full) - 1 : kInf; });
  } else {
    input->depth_kind = static_cast<DepthKind>(o.depth_kind);
  }
  return {};
}

// How depth layers and channels of the chosen part are named.
std::string layer_channel(int k, const char* end) { return fmt::format("layer{}.{}", k + 1, end); }

// What an EXR file has beside its pixels that later steps need.
struct ExrSource {
  ExrHeader header;
  ExrChannelChoice choice;
  bool blender = false;  // its normals are in world space, without a matrix in the file
  bool half_depth = false;
};

Status read_flat(const std::string& path, const DepthFileOptions& o, ExrSource* source,
                 DepthInput* input) {
  ExrHeader& header = source->header;
  const ExrChannelChoice& choice = source->choice;
  const bool normals = !choice.normals[0].empty();
  std::vector<std::string> wanted{choice.depth};
  if (!choice.back_depth.empty()) wanted.push_back(choice.back_depth);
  if (normals) wanted.insert(wanted.end(), std::begin(choice.normals), std::end(choice.normals));
  int layers = 0;
  while (layers < o.layers && header.find(layer_channel(layers, "Z")) &&
         header.find(layer_channel(layers, "ZBack"))) {
    wanted.push_back(layer_channel(layers, "Z"));
    wanted.push_back(layer_channel(layers++, "ZBack"));
  }
  Image image;
  if (Status s = read_exr(path, wanted, &header, &image, header.part); !s.ok()) return s;
  const PixelWindow whole = header.whole_window();
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
  return {};
}

// A deep image is depth layers: the first is depth and back depth too.
Status read_deep(const std::string& path, const DepthFileOptions& o, const ExrHeader& header,
                 DepthInput* input) {
  std::vector<DeepLayer> layers;
  if (Status s = read_exr_deep(path, header.part, std::max(o.layers, 1), &layers); !s.ok()) {
    return s;
  }
  if (layers.empty()) {
    return invalid_input(fmt::format("{}: a deep image without a single sample", path));
  }
  const PixelWindow whole = header.whole_window();
  for (DeepLayer& layer : layers) {
    input->layers.push_back({over_whole(std::move(layer.front), header.data_window, whole),
                             over_whole(std::move(layer.back), header.data_window, whole)});
  }
  input->depth = input->layers[0].front;
  if (header.find("ZBack")) {
    input->back_depth = input->layers[0].back;
  } else {
    input->layers.clear();
  }
  return {};
}

Status read_exr_source(const std::string& path, const DepthFileOptions& o, ExrSource* source,
                       DepthInput* input) {
  std::vector<ExrHeader> parts;
  if (Status s = read_exr_headers(path, &parts); !s.ok()) return s;
  int part = 0;
  if (Status s = choose_exr_part(path, parts, o, &part); !s.ok()) return s;
  source->header = parts[part];
  const ExrHeader& header = source->header;
  if (parts.size() > 1) {
    input->notes.push_back(fmt::format("{}: of its {} parts, number {}{} is read (--part)", path,
                                       parts.size(), part,
                                       header.part_name.empty() ? "" : ", " + header.part_name));
  }
  if (Status s = choose_exr_channels(path, header, o, &source->choice); !s.ok()) return s;
  for (const std::string& name : header.attributes) {
    source->blender |= name == "BlenderMultiChannel" || name.starts_with("cycles.");
  }
  const auto* depth = header.find(source->choice.depth);
  source->half_depth = depth && depth->type == "half";
  const PixelWindow whole = header.whole_window();
  if (Status s = check_whole_window(path, header.data_window, whole); !s.ok()) return s;
  const PixelWindow& display = header.display_window;
  input->width = whole.width();
  input->height = whole.height();
  input->guard_band = {display.min_x - whole.min_x, whole.max_x - display.max_x,
                       display.min_y - whole.min_y, whole.max_y - display.max_y};
  if (header.deep) return read_deep(path, o, header, input);
  return read_flat(path, o, source, input);
}

// Normals of the file to eye space, as far as options and attributes say how; the rest is checked.
Status settle_normals(const std::string& path, const DepthFileOptions& o, const ExrSource& source,
                      bool looks_along_plus_z, DepthInput* input) {
  if (input->normal_x.empty()) return {};
  const std::string names = fmt::format("{}, {}, {}", source.choice.normals[0],
                                        source.choice.normals[1], source.choice.normals[2]);
  const bool world = o.normal_space == NormalSpace::kWorld || !o.world_to_camera.empty();
  if (o.normals_packed) {
    for (auto* n : {&input->normal_x, &input->normal_y, &input->normal_z}) {
      for (float& v : *n) v = 2 * v - 1;
    }
  }
  if (!world && source.blender && o.normal_space == NormalSpace::kAuto) {
    for (auto* n : {&input->normal_x, &input->normal_y, &input->normal_z}) n->clear();
    input->notes.push_back(
        fmt::format("{}: written by Blender, whose normals ({}) are in world space; normals from "
                    "depth are used "
                    "instead; --world-to-camera FILE makes use of the file's",
                    path, names));
    return {};
  }
  if (world) {
    ExrHeader::Matrix m;
    if (!o.world_to_camera.empty()) {
      double column[16];
      if (Status s = read_matrix(o.world_to_camera, "a world-to-camera file", column); !s.ok()) {
        return s;
      }
      // OpenEXR's are for row vectors.
      for (int i = 0; i < 16; ++i) m[i] = column[i % 4 * 4 + i / 4];
      looks_along_plus_z = false;
    } else if (source.header.world_to_camera) {
      m = *source.header.world_to_camera;
    } else {
      return invalid_input(
          fmt::format("{}: world-space normals need --world-to-camera FILE or the "
                      "attribute worldToCamera, which it lacks",
                      path));
    }
    normals_to_eye_space(m, looks_along_plus_z, input);
  }
  if (o.normal_space == NormalSpace::kView && !world) return {};
  return check_normals(names, world, input);
}

Status load_exr(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  ExrSource source;
  if (Status s = read_exr_source(path, o, &source, input); !s.ok()) return s;
  const ExrHeader& header = source.header;
  if (Status s = settle_depth(o, source.half_depth, input); !s.ok()) return s;
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
  if (known) derived = camera_from_exr(path, header, header.whole_window(), &camera);
  if (known && !gives_camera(o)) {
    if (!derived.ok()) return derived;
    input->camera = camera.camera;
  } else if (Status s = set_camera(path, o, input); !s.ok()) {
    return s;
  }
  return settle_normals(path, o, source, camera.looks_along_plus_z, input);
}

Status check_exr_only(const std::string& path, const DepthFileOptions& o) {
  const char* option = !o.depth_channel.empty()        ? "depth-channel"
                       : !o.back_depth_channel.empty() ? "back-depth-channel"
                       : !o.part.empty()               ? "part"
                       : !o.world_to_camera.empty()    ? "world-to-camera"
                       : o.normals != "auto" && o.normals != "none" && o.normals != "depth"
                           ? "normals"
                           : nullptr;
  if (!option) return {};
  return invalid_argument(
      fmt::format("{} is not an EXR file; {} is for channels of one", path, option));
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
  return settle_depth(o, false, input);
}

// PNG: near + v / 65535 (far - near), v times depth-scale, or NDC as it is; 65535 is background.
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
  const bool metric =
      o.depth_kind == FileDepthKind::kLinear || o.depth_kind == FileDepthKind::kDistance;
  if (!metric) return settle_depth(o, false, input);
  // As stored, in whole numbers: that is what background and invalid name.
  for (float& v : input->depth) v = v >= 1 ? kNan : std::round(v * 65535);
  if (o.depth_scale) {
    if (o.near) {
      return invalid_argument("near and depth-scale exclude each other for a PNG");
    }
    return settle_depth(o, false, input);
  }
  if (!o.near || !o.far || !(*o.far > *o.near) || !std::isfinite(*o.far)) {
    return invalid_argument(fmt::format(
        "{}: a PNG depth image needs depth-scale, or near and far with near < far < inf", path));
  }
  // Black is the near plane, so that no value means nothing by itself.
  DepthFileOptions named = o;
  named.background.none = true;
  if (Status s = settle_depth(named, false, input); !s.ok()) return s;
  for (float& v : input->depth) {
    if (v < kInf) v = static_cast<float>(*o.near + v / 65535 * (*o.far - *o.near));
  }
  return {};
}

}  // namespace

Status load_depth_input(const std::string& path, const DepthFileOptions& o, DepthInput* input) {
  const std::string ending = file_ending(path);
  DepthInput loaded;
  loaded.name = path;
  if (o.near) loaded.near_plane = static_cast<float>(*o.near);
  // The far plane of logarithmic depth is a number of its formula: nothing lies beyond.
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

bool SettingText<std::optional<tools::Intrinsics>>::parse(std::string_view text,
                                                          std::optional<tools::Intrinsics>* value) {
  double v[4];
  if (!tools::parse_numbers(text, ',', 4, v)) return false;
  *value = tools::Intrinsics{v[0], v[1], v[2], v[3]};
  return true;
}

std::string SettingText<std::optional<tools::Intrinsics>>::write(
    const std::optional<tools::Intrinsics>& value) {
  return value ? fmt::format("{},{},{},{}", value->fx, value->fy, value->cx, value->cy) : "";
}

std::string SettingText<std::optional<tools::GuardBandSpec>>::write(
    const std::optional<tools::GuardBandSpec>& value) {
  return value ? SettingText<tools::GuardBandSpec>::write(*value) : "";
}

}  // namespace obscura
