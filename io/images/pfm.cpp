#include "io/images/pfm.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

// The next word of the header; empty at its end. One white-space character is eaten after it.
std::string_view next_word(std::string_view bytes, std::size_t* at) {
  auto space = [&](std::size_t i) {
    return bytes[i] == ' ' || bytes[i] == '\n' || bytes[i] == '\t' || bytes[i] == '\r';
  };
  while (*at < bytes.size() && space(*at)) ++*at;
  const std::size_t begin = *at;
  while (*at < bytes.size() && !space(*at) && *at - begin < 32) ++*at;
  const std::string_view word = bytes.substr(begin, *at - begin);
  if (*at < bytes.size()) ++*at;
  return word;
}

template <class T>
bool read_number(std::string_view word, T* value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), *value);
  return error == std::errc() && end == word.data() + word.size();
}

float swapped(float v) {
  return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(v)));
}

}  // namespace

Status decode_pfm(std::string_view bytes, const std::string& name, Image* image) {
  auto bad = [&](const std::string& what) {
    return invalid_input(fmt::format("{}: {}", name, what));
  };
  std::size_t at = 0;
  const std::string_view magic = next_word(bytes, &at);
  if (magic != "PF" && magic != "Pf") return bad("not a PFM file (it must begin with PF or Pf)");
  const int channels = magic == "PF" ? 3 : 1;
  int width = 0, height = 0;
  float scale = 0;
  if (!read_number(next_word(bytes, &at), &width) || !read_number(next_word(bytes, &at), &height) ||
      !read_number(next_word(bytes, &at), &scale)) {
    return bad("the PFM header is damaged; it must hold width, height and scale");
  }
  if (width < 1 || height < 1 || width > 65535 || height > 65535) {
    return bad(fmt::format("size {}x{}; each side must be in [1, 65535]", width, height));
  }
  if (!std::isfinite(scale) || scale == 0) return bad("the PFM scale must be finite and not 0");
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  const std::size_t needed = pixels * channels * sizeof(float);
  if (bytes.size() - at < needed) {
    return bad(fmt::format("truncated: {} bytes of pixels where {}x{} needs {}", bytes.size() - at,
                           width, height, needed));
  }
  Image result(width, height);
  for (const char* channel : {"R", "G", "B"}) {
    result.add(channels == 1 ? "Y" : channel);
    if (channels == 1) break;
  }
  const bool swap = (scale > 0) != (std::endian::native == std::endian::big);
  for (int y = 0; y < height; ++y) {
    const char* row =
        bytes.data() + at + static_cast<std::size_t>(height - 1 - y) * width * channels * 4;
    for (int c = 0; c < channels; ++c) {
      float* out = result.channels[c].values.data() + static_cast<std::size_t>(y) * width;
      for (int x = 0; x < width; ++x) {
        float v;
        std::memcpy(&v, row + (static_cast<std::size_t>(x) * channels + c) * 4, 4);
        out[x] = swap ? swapped(v) : v;
      }
    }
  }
  *image = std::move(result);
  return {};
}

Status encode_pfm(const Image& image, std::string* bytes) {
  const std::size_t channels = image.channels.size();
  if (channels != 1 && channels != 3) {
    return invalid_argument(
        fmt::format("a PFM file holds 1 or 3 channels; there are {} to write", channels));
  }
  *bytes = fmt::format("{}\n{} {}\n{}\n", channels == 3 ? "PF" : "Pf", image.width, image.height,
                       std::endian::native == std::endian::big ? "1.0" : "-1.0");
  const std::size_t header = bytes->size();
  bytes->resize(header + static_cast<std::size_t>(image.width) * image.height * channels * 4);
  char* out = bytes->data() + header;
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      for (std::size_t c = 0; c < channels; ++c, out += 4) {
        const float v = image.channels[c].values[static_cast<std::size_t>(y) * image.width + x];
        std::memcpy(out, &v, 4);
      }
    }
  }
  return {};
}

}  // namespace obscura::tools
