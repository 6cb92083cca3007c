#include "support/files/png.h"

#include <png.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "fmt/format.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_HDR
#define STBI_MAX_DIMENSIONS 65535
#include "stb/stb_image.h"
#pragma GCC diagnostic pop

namespace obscura::support {
namespace {

const stbi_uc* data_of(std::string_view bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());
}

Status undecodable(const std::string& name, const char* format) {
  const char* reason = stbi_failure_reason();
  return invalid_input(
      fmt::format("{}: not a readable {} file ({})", name, format, reason ? reason : "damaged"));
}

template <class T>
Image from_interleaved(const T* pixels, int width, int height, int stored, int used, float scale) {
  Image image(width, height);
  const char* const names[] = {"R", "G", "B"};
  const std::size_t count = static_cast<std::size_t>(width) * height;
  for (int c = 0; c < used; ++c) {
    std::vector<float>& out = image.add(used == 1 ? "Y" : names[c]);
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = static_cast<float>(pixels[i * stored + c]) * scale;
    }
  }
  return image;
}

}  // namespace

Status decode_png(std::string_view bytes, const std::string& name, Image* image,
                  bool* sixteen_bits) {
  if (bytes.size() > INT_MAX) return invalid_input(name + ": larger than 2 GiB");
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_us, decltype(&stbi_image_free)> pixels(
      stbi_load_16_from_memory(data_of(bytes), size, &width, &height, &channels, 0),
      stbi_image_free);
  if (!pixels) return undecodable(name, "PNG");
  *image =
      from_interleaved(pixels.get(), width, height, channels, channels < 3 ? 1 : 3, 1 / 65535.0f);
  if (sixteen_bits) *sixteen_bits = stbi_is_16_bit_from_memory(data_of(bytes), size) != 0;
  return {};
}

Status decode_hdr(std::string_view bytes, const std::string& name, Image* image) {
  if (bytes.size() > INT_MAX) return invalid_input(name + ": larger than 2 GiB");
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<float, decltype(&stbi_image_free)> pixels(
      stbi_is_hdr_from_memory(data_of(bytes), size)
          ? stbi_loadf_from_memory(data_of(bytes), size, &width, &height, &channels, 3)
          : nullptr,
      stbi_image_free);
  if (!pixels) return undecodable(name, "Radiance HDR");
  *image = from_interleaved(pixels.get(), width, height, 3, 3, 1.0f);
  return {};
}

Status encode_png(const Image& image, std::string* bytes) {
  const std::size_t channels = image.channels.size();
  if (channels != 1 && channels != 3) {
    return invalid_argument(
        fmt::format("a PNG file holds 1 or 3 channels; there are {} to write", channels));
  }
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  std::vector<std::uint8_t> interleaved(pixels * channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const float* in = image.channels[c].values.data();
    for (std::size_t i = 0; i < pixels; ++i) {
      const float v = std::isnan(in[i]) ? 0.0f : std::clamp(in[i], 0.0f, 1.0f);
      interleaved[i * channels + c] = static_cast<std::uint8_t>(std::lround(v * 255));
    }
  }
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
  header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  bytes->resize(size);
  if (!png_image_write_to_memory(&header, bytes->data(), &size, 0, interleaved.data(), 0,
                                 nullptr)) {
    return {StatusCode::kInternal, fmt::format("cannot encode PNG: {}", header.message)};
  }
  bytes->resize(size);
  return {};
}

}  // namespace obscura::support
