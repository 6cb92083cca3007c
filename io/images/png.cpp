#include "io/images/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "fmt/format.h"
#include "io/images/unfolding.h"

namespace obscura::tools {
namespace {

constexpr int kMostPixels = 65535;  // on a side
// Deflate shrinks by at most 1032; a file smaller than that allows holds no such image.
constexpr std::size_t kMostCompression = 1032;

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

// libpng reports an error by a jump, past frames that must therefore own nothing. The two functions
// that set the jump's target (read_samples, write_samples) keep everything here.
struct Session {
  std::string_view in;  // reading
  std::size_t at = 0;
  std::string* out = nullptr;  // writing
  // From calloc: what no data have come for takes no memory.
  std::unique_ptr<png_byte[], Free> samples;
  std::vector<png_bytep> rows;
  int width = 0, height = 0, channels = 0, bits = 0;
  char error[160] = "";
};

Session& session_of(png_structp png) { return *static_cast<Session*>(png_get_error_ptr(png)); }

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  std::strncpy(session_of(png).error, message, sizeof(Session::error) - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep data, png_size_t size) {
  Session& s = session_of(png);
  if (size > s.in.size() - s.at) png_error(png, "truncated");
  std::memcpy(data, s.in.data() + s.at, size);
  s.at += size;
}

void on_write(png_structp png, png_bytep data, png_size_t size) {
  session_of(png).out->append(reinterpret_cast<const char*>(data), size);
}

void set_rows(Session* s, std::size_t row_bytes) {
  s->samples.reset(static_cast<png_byte*>(std::calloc(row_bytes, std::size_t(s->height))));
  if (!s->samples) throw std::bad_alloc();
  s->rows.resize(s->height);
  for (int y = 0; y < s->height; ++y) s->rows[y] = s->samples.get() + y * row_bytes;
}

Status check_size(const std::string& name, const Session& s) {
  return check_unfolding(name, s.width, s.height, s.channels, static_cast<double>(s.in.size()));
}

bool read_samples(png_structp png, png_infop info, Session* s) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, nullptr, on_read);
  png_set_user_limits(png, kMostPixels, kMostPixels);
  png_read_info(png, info);
  if (png_get_rowbytes(png, info) * png_get_image_height(png, info) / kMostCompression >
      s->in.size()) {
    png_error(png, "truncated: too few bytes for its size");
  }
  png_set_palette_to_rgb(png);
  png_set_expand_gray_1_2_4_to_8(png);
  png_set_strip_alpha(png);
  png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  s->width = static_cast<int>(png_get_image_width(png, info));
  s->height = static_cast<int>(png_get_image_height(png, info));
  s->channels = png_get_channels(png, info);
  s->bits = png_get_bit_depth(png, info);
  if (!check_size("", *s).ok()) return false;
  set_rows(s, png_get_rowbytes(png, info));
  png_read_image(png, s->rows.data());
  png_read_end(png, nullptr);
  return true;
}

bool write_samples(png_structp png, png_infop info, Session* s) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, nullptr, on_write, nullptr);
  png_set_user_limits(png, kMostPixels, kMostPixels);
  png_set_IHDR(png, info, static_cast<png_uint_32>(s->width), static_cast<png_uint_32>(s->height),
               s->bits, s->channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 3);
  png_write_info(png, info);
  png_set_swap(png);
  png_write_image(png, s->rows.data());
  png_write_end(png, nullptr);
  return true;
}

template <class Sample>
void planes_from(const Session& s, float full, Image* image) {
  for (int c = 0; c < s.channels; ++c) {
    std::vector<float>& out = image->add(s.channels == 1 ? "Y" : c == 0 ? "R" : c == 1 ? "G" : "B");
    for (int y = 0; y < s.height; ++y) {
      const png_byte* row = s.rows[y];
      for (int x = 0; x < s.width; ++x) {
        Sample v;
        std::memcpy(&v, row + (static_cast<std::size_t>(x) * s.channels + c) * sizeof(v),
                    sizeof(v));
        out[static_cast<std::size_t>(y) * s.width + x] = static_cast<float>(v) / full;
      }
    }
  }
}

template <class Sample>
void planes_to(const Image& image, float full, Session* s) {
  for (int c = 0; c < s->channels; ++c) {
    const std::vector<float>& in = image.channels[c].values;
    for (int y = 0; y < s->height; ++y) {
      for (int x = 0; x < s->width; ++x) {
        const float value = in[static_cast<std::size_t>(y) * s->width + x];
        const float unit = std::isnan(value) ? 0.0f : std::clamp(value, 0.0f, 1.0f);
        const Sample v = static_cast<Sample>(unit * full + 0.5f);
        std::memcpy(s->rows[y] + (static_cast<std::size_t>(x) * s->channels + c) * sizeof(v), &v,
                    sizeof(v));
      }
    }
  }
}

}  // namespace

Status decode_png(std::string_view bytes, const std::string& name, Image* image,
                  bool* sixteen_bits) {
  Session s;
  s.in = bytes;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return {StatusCode::kOutOfMemory, name + ": no memory to read a PNG file"};
  }
  bool good = false;
  try {
    good = read_samples(png, info, &s);
  } catch (const std::bad_alloc&) {
    png_destroy_read_struct(&png, &info, nullptr);
    throw;
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (Status size = check_size(name, s); !size.ok()) return size;
  if (!good) {
    return invalid_input(fmt::format("{}: not a readable PNG file ({})", name, s.error));
  }
  Image result(s.width, s.height);
  if (s.bits == 16) {
    planes_from<std::uint16_t>(s, 65535, &result);
  } else {
    planes_from<std::uint8_t>(s, 255, &result);
  }
  *image = std::move(result);
  if (sixteen_bits) *sixteen_bits = s.bits == 16;
  return {};
}

Status encode_png(const Image& image, int bits, std::string* bytes) {
  const std::size_t channels = image.channels.size();
  if (channels != 1 && channels != 3) {
    return invalid_argument(
        fmt::format("a PNG file holds 1 or 3 channels; there are {} to write", channels));
  }
  if (bits != 8 && bits != 16) {
    return invalid_argument(fmt::format("a PNG file has 8 or 16 bits per channel, not {}", bits));
  }
  Session s;
  s.out = bytes;
  s.width = image.width;
  s.height = image.height;
  s.channels = static_cast<int>(channels);
  s.bits = bits;
  set_rows(&s, static_cast<std::size_t>(image.width) * channels * (bits / 8));
  if (bits == 16) {
    planes_to<std::uint16_t>(image, 65535, &s);
  } else {
    planes_to<std::uint8_t>(image, 255, &s);
  }
  bytes->clear();
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &s, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool good = info && write_samples(png, info, &s);
  png_destroy_write_struct(&png, info ? &info : nullptr);
  if (good) return {};
  return {StatusCode::kInternal, fmt::format("cannot encode PNG: {}", s.error)};
}

}  // namespace obscura::tools
