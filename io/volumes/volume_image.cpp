#include "io/volumes/volume_image.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>

namespace obscura::tools {
namespace {

constexpr int kMaxSide = 8192;
constexpr const char* kAxis[] = {"x", "y", "z"};

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool parse_end(std::string_view text, int* value) {
  if (text.empty()) return true;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return error == std::errc() && end == text.data() + text.size() && *value >= 0;
}

}  // namespace

std::size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::kU8:
      return 1;
    case VoxelType::kI16:
    case VoxelType::kU16:
      return 2;
    case VoxelType::kF32:
      return 4;
  }
  return 0;
}

Double3 VolumeImage::spacing() const {
  return {std::sqrt(dot(axes[0], axes[0])), std::sqrt(dot(axes[1], axes[1])),
          std::sqrt(dot(axes[2], axes[2]))};
}

VolumeView VolumeImage::view() const {
  VolumeView v;
  v.data = samples.data();
  v.type = type;
  v.size = size;
  const Double3 h = spacing();
  v.spacing = {float(h[0]), float(h[1]), float(h[2])};
  v.slope = slope;
  v.intercept = intercept;
  return v;
}

Double3 VolumeImage::direction_to_grid(const Double3& w) const {
  const Double3 h = spacing();
  return {dot(axes[0], w) / h[0], dot(axes[1], w) / h[1], dot(axes[2], w) / h[2]};
}

Double3 VolumeImage::to_grid(const Double3& w) const {
  return direction_to_grid({w[0] - origin[0], w[1] - origin[1], w[2] - origin[2]});
}

Double3 VolumeImage::to_world(const Double3& g) const {
  const Double3 h = spacing();
  Double3 w = origin;
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) w[k] += g[a] / h[a] * axes[a][k];
  }
  return w;
}

Status check_geometry(const VolumeImage& image) {
  for (int a = 0; a < 3; ++a) {
    if (image.size[a] < 1 || image.size[a] > kMaxSide) {
      return invalid_input(fmt::format("{}: its side along {} is {} voxels; it must be in [1, {}]",
                                       image.name, kAxis[a], image.size[a], kMaxSide));
    }
  }
  const Double3 h = image.spacing();
  for (int a = 0; a < 3; ++a) {
    if (!(h[a] >= 1e-12 && h[a] <= 1e12) || !std::isfinite(image.origin[a])) {
      return invalid_input(
          fmt::format("{}: its spacing along {} is {} and its origin {}; they "
                      "must be finite and the spacing in [1e-12, 1e12]",
                      image.name, kAxis[a], h[a], image.origin[a]));
    }
  }
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const double cosine = dot(image.axes[a], image.axes[b]) / (h[a] * h[b]);
    if (std::abs(cosine) > 2e-3) {
      return invalid_input(
          fmt::format("{}: its {} and {} axes meet at {:.2f} degrees; sheared "
                      "volumes must be resampled to right angles",
                      image.name, kAxis[a], kAxis[b], std::acos(cosine) * 180 / 3.14159265358979));
    }
  }
  return {};
}

Status parse_clip(const std::string& text, ClipBox* box) {
  ClipBox result;
  std::string_view rest = text;
  bool good = true;
  for (int a = 0; a < 3 && good; ++a) {
    const std::size_t comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    const std::size_t colon = part.find(':');
    good = (comma == std::string_view::npos) == (a == 2) && colon != std::string_view::npos &&
           parse_end(part.substr(0, colon), &result.first[a]) &&
           parse_end(part.substr(colon + 1), &result.last[a]);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  if (!good) {
    return invalid_argument(fmt::format(
        "clip is '{}'; it must be x0:x1,y0:y1,z0:z1 in voxels from 0, both ends included", text));
  }
  *box = result;
  return {};
}

Status clip(const ClipBox& box, VolumeImage* image) {
  std::array<int, 3> last = box.last, size;
  for (int a = 0; a < 3; ++a) {
    if (last[a] < 0) last[a] = image->size[a] - 1;
    if (box.first[a] > last[a] || last[a] >= image->size[a]) {
      return invalid_argument(fmt::format(
          "clip along {} is {}:{}; it must rise and stay within 0:{} ({} has {} voxels there)",
          kAxis[a], box.first[a], last[a], image->size[a] - 1, image->name, image->size[a]));
    }
    size[a] = last[a] - box.first[a] + 1;
  }
  const std::size_t bytes = bytes_of(image->type);
  std::vector<std::byte> kept(bytes * size[0] * size[1] * size[2]);
  std::byte* out = kept.data();
  const std::size_t row = bytes * size[0];
  for (int z = box.first[2]; z <= last[2]; ++z) {
    for (int y = box.first[1]; y <= last[1]; ++y, out += row) {
      const std::size_t from =
          (std::size_t(z) * image->size[1] + y) * image->size[0] + box.first[0];
      std::memcpy(out, image->samples.data() + bytes * from, row);
    }
  }
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) image->origin[k] += box.first[a] * image->axes[a][k];
  }
  image->samples = std::move(kept);
  image->size = size;
  return {};
}

}  // namespace obscura::tools
