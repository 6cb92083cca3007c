// G. Ward, "Real Pixels", Graphics Gems II, and the file format of Radiance.
#include "io/images/hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fmt/format.h"
#include "io/images/unfolding.h"

namespace obscura::tools {
namespace {

using Pixel = std::array<std::uint8_t, 4>;  // three mantissas and their exponent

constexpr double kMostRadiance = 3e38;  // a float's

// The number at the start of `text`, which is shortened by it; false where there is none.
bool next_number(std::string_view* text, double* value) {
  while (text->starts_with(' ') || text->starts_with('\t')) text->remove_prefix(1);
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), *value);
  text->remove_prefix(static_cast<std::size_t>(end - text->data()));
  return error == std::errc();
}

// What has been multiplied into the pixels of each channel: the product of all lines.
struct Multipliers {
  std::array<double, 3> of = {1, 1, 1};

  // False if the line is such a one and its numbers are out of range.
  bool read(std::string_view line) {
    std::array<double, 3> values = {};
    if (line.starts_with("EXPOSURE=")) {
      line.remove_prefix(9);
      if (!next_number(&line, &values[0])) return false;
      values[1] = values[2] = values[0];
    } else if (line.starts_with("COLORCORR=")) {
      line.remove_prefix(10);
      for (double& value : values) {
        if (!next_number(&line, &value)) return false;
      }
    } else {
      return true;
    }
    for (int c = 0; c < 3; ++c) {
      of[c] *= values[c];
      if (!(of[c] >= 1e-30 && of[c] <= 1e30)) return false;
    }
    return true;
  }
};

// The next line, without its end; false where there is none.
bool next_line(std::string_view bytes, std::size_t* at, std::string_view* line) {
  const std::size_t end = bytes.find('\n', *at);
  if (end == std::string_view::npos) return false;
  *line = bytes.substr(*at, end - *at);
  if (line->ends_with('\r')) line->remove_suffix(1);
  *at = end + 1;
  return true;
}

// "-Y HEIGHT +X WIDTH".
bool parse_size(std::string_view line, int* width, int* height) {
  auto number = [&](std::string_view axis, int* value) {
    if (!line.starts_with(axis)) return false;
    const char* begin = line.data() + axis.size();
    const auto [end, error] = std::from_chars(begin, line.data() + line.size(), *value);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return error == std::errc();
  };
  return number("-Y ", height) && number(" +X ", width) && line.empty();
}

class Scanlines {
 public:
  Scanlines(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  // False where the file ends or a run leaves the row.
  bool read(std::vector<Pixel>* row) {
    const std::size_t width = row->size();
    if (bytes_.size() - at_ < 4) return false;
    const bool by_component = width >= 8 && width < 32768 && byte(0) == 2 && byte(1) == 2 &&
                              (std::size_t{byte(2)} << 8 | byte(3)) == width;
    return by_component ? read_components(row) : read_pixels(row);
  }

 private:
  std::uint8_t byte(std::size_t i) const { return static_cast<std::uint8_t>(bytes_[at_ + i]); }

  bool read_components(std::vector<Pixel>* row) {
    at_ += 4;
    for (int c = 0; c < 4; ++c) {
      for (std::size_t x = 0; x < row->size();) {
        if (bytes_.size() - at_ < 2) return false;
        const bool run = byte(0) > 128;
        const std::size_t count = run ? byte(0) - 128u : byte(0);
        const std::size_t stored = run ? 1 : count;
        ++at_;
        if (count == 0 || count > row->size() - x || bytes_.size() - at_ < stored) return false;
        for (std::size_t i = 0; i < count; ++i) (*row)[x++][c] = byte(run ? 0 : i);
        at_ += stored;
      }
    }
    return true;
  }

  // Pixel by pixel; (1, 1, 1, n) repeats the one before, and such runs in a row are the digits of
  // a number in base 256, lowest first.
  bool read_pixels(std::vector<Pixel>* row) {
    int shift = 0;
    for (std::size_t x = 0; x < row->size();) {
      if (bytes_.size() - at_ < 4) return false;
      const Pixel p{byte(0), byte(1), byte(2), byte(3)};
      at_ += 4;
      if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
        (*row)[x++] = p;
        shift = 0;
        continue;
      }
      if (x == 0 || shift > 16) return false;
      const std::size_t count = std::size_t{p[3]} << shift;
      if (count > row->size() - x) return false;
      const Pixel previous = (*row)[x - 1];
      for (std::size_t i = 0; i < count; ++i) (*row)[x++] = previous;
      shift += 8;
    }
    return true;
  }

  const std::string_view bytes_;
  std::size_t at_;
};

}  // namespace

Status decode_hdr(std::string_view bytes, const std::string& name, Image* image) {
  auto bad = [&](const std::string& what) {
    return invalid_input(fmt::format("{}: not a readable Radiance HDR file ({})", name, what));
  };
  std::size_t at = 0;
  std::string_view line;
  if (!bytes.starts_with("#?") || !next_line(bytes, &at, &line))
    return bad("it must begin with #?");
  Multipliers multipliers;
  while (next_line(bytes, &at, &line) && !line.empty()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      return bad(fmt::format("{}; it must be 32-bit_rle_rgbe", line.substr(0, 60)));
    }
    if (!multipliers.read(line)) {
      return bad(fmt::format("{}; the numbers must be positive, in [1e-30, 1e30] in all",
                             line.substr(0, 60)));
    }
  }
  int width = 0, height = 0;
  if (!next_line(bytes, &at, &line)) return bad("truncated in its header");
  if (!parse_size(line, &width, &height)) {
    return bad(fmt::format("its size is '{}'; it must be -Y HEIGHT +X WIDTH", line.substr(0, 60)));
  }
  if (width < 1 || height < 1 || width > 65535 || height > 65535) {
    return bad(fmt::format("size {}x{}; each side must be in [1, 65535]", width, height));
  }
  // A row takes at least a pixel; then memory grows with what has been read.
  if (bytes.size() - at < static_cast<std::size_t>(height) * 4) return bad("truncated");
  if (Status s = check_unfolding(name, width, height, 3, static_cast<double>(bytes.size()));
      !s.ok()) {
    return s;
  }
  Image result(width, 0);
  for (const char* channel : {"R", "G", "B"}) result.add(channel);
  Scanlines scanlines(bytes, at);
  std::vector<Pixel> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    if (!scanlines.read(&row)) return bad(fmt::format("truncated or damaged in row {}", y));
    for (int c = 0; c < 3; ++c) {
      std::vector<float>& out = result.channels[c].values;
      for (const Pixel& p : row) {
        const double value = p[3] == 0 ? 0.0 : std::ldexp(static_cast<double>(p[c]), p[3] - 136);
        out.push_back(static_cast<float>(std::min(value / multipliers.of[c], kMostRadiance)));
      }
    }
  }
  result.height = height;
  *image = std::move(result);
  return {};
}

}  // namespace obscura::tools
