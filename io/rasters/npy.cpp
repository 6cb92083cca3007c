#include "io/rasters/npy.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "fmt/format.h"

namespace obscura::tools {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr long long kMostCells = 1 << 20;  // a side

struct Header {
  char order = '<', kind = 0;
  int bytes = 0;
  bool fortran = false;
  long long height = 0, width = 0;
  std::size_t data = 0;  // where samples begin
};

// What follows 'key': in the dictionary, without leading blanks; empty where there is none.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
  const std::size_t at = dictionary.find("'" + std::string(key) + "'");
  if (at == std::string_view::npos) return {};
  std::string_view rest = dictionary.substr(at + key.size() + 2);
  while (!rest.empty() && (rest[0] == ' ' || rest[0] == ':')) rest.remove_prefix(1);
  return rest;
}

bool read_number(std::string_view* text, long long* number) {
  while (!text->empty() && (text->front() == ' ' || text->front() == '(' || text->front() == ',')) {
    text->remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), *number);
  if (error != std::errc()) return false;
  text->remove_prefix(static_cast<std::size_t>(end - text->data()));
  return true;
}

Status read_header(std::string_view bytes, const std::string& name, Header* h) {
  auto bad = [&](const std::string& what) {
    return invalid_input(fmt::format("{}: not a readable NumPy file ({})", name, what));
  };
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) return bad("no NumPy header");
  const bool wide = bytes[6] != 1;  // version 1 has two bytes for the length, later ones four
  std::size_t length = 0;
  for (int i = wide ? 3 : 1; i >= 0; --i) {
    length = length << 8 | static_cast<unsigned char>(bytes[8 + i]);
  }
  h->data = (wide ? 12 : 10) + length;
  if (h->data > bytes.size()) return bad("truncated");
  const std::string_view dictionary = bytes.substr(wide ? 12 : 10, length);
  const std::string_view type = value_of(dictionary, "descr");
  if (type.size() < 4 || type[0] != '\'') return bad("it holds no plain numbers");
  h->order = type[1];
  h->kind = type[2];
  h->bytes = type[3] - '0';
  h->fortran = value_of(dictionary, "fortran_order").starts_with("True");
  std::string_view shape = value_of(dictionary, "shape");
  long long extra = 0;
  if (!read_number(&shape, &h->height) || !read_number(&shape, &h->width) ||
      read_number(&shape, &extra)) {
    return invalid_input(fmt::format("{}: heights must be an array with two axes", name));
  }
  if (h->height < 1 || h->width < 1 || h->height > kMostCells || h->width > kMostCells) {
    return bad(fmt::format("its shape is ({}, {})", h->height, h->width));
  }
  const bool whole = (h->kind == 'i' || h->kind == 'u') && type[4] == '\'' &&
                     (h->bytes == 1 || h->bytes == 2 || h->bytes == 4 || h->bytes == 8);
  const bool real = h->kind == 'f' && type[4] == '\'' && (h->bytes == 4 || h->bytes == 8);
  if (!whole && !real) {
    return bad("its numbers must be integers, float32 or float64");
  }
  const auto needed = static_cast<std::uint64_t>(h->height) * static_cast<std::uint64_t>(h->width) *
                      static_cast<std::uint64_t>(h->bytes);
  if (bytes.size() - h->data < needed) return bad("truncated");
  return {};
}

template <class T>
float sample(const char* at, bool swap) {
  char raw[sizeof(T)];
  std::memcpy(raw, at, sizeof(T));
  if (swap) std::reverse(raw, raw + sizeof(T));
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<float>(value);
}

using Sample = float (*)(const char*, bool);
Sample sample_of(const Header& h) {
  if (h.kind == 'f') return h.bytes == 4 ? sample<float> : sample<double>;
  const bool sign = h.kind == 'i';
  switch (h.bytes) {
    case 1:
      return sign ? sample<std::int8_t> : sample<std::uint8_t>;
    case 2:
      return sign ? sample<std::int16_t> : sample<std::uint16_t>;
    case 4:
      return sign ? sample<std::int32_t> : sample<std::uint32_t>;
    default:
      return sign ? sample<std::int64_t> : sample<std::uint64_t>;
  }
}

}  // namespace

Status decode_npy(std::string_view bytes, const std::string& name, Image* image) {
  Header h;
  if (Status s = read_header(bytes, name, &h); !s.ok()) return s;
  const Sample read = sample_of(h);
  const bool swap = (h.order == '>') == (std::endian::native == std::endian::little) &&
                    h.order != '|' && h.order != '=';
  Image result(static_cast<int>(h.width), static_cast<int>(h.height));
  float* out = result.add("Y").data();
  const char* data = bytes.data() + h.data;
  for (long long y = 0; y < h.height; ++y) {
    for (long long x = 0; x < h.width; ++x) {
      const long long at = h.fortran ? x * h.height + y : y * h.width + x;
      *out++ = read(data + at * h.bytes, swap);
    }
  }
  *image = std::move(result);
  return {};
}

void encode_npy(const Image& image, std::string* bytes) {
  static_assert(std::endian::native == std::endian::little);
  const bool several = image.channels.size() > 1;
  std::string dictionary = fmt::format(
      "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}{}, {}), }}",
      several ? fmt::format("{}, ", image.channels.size()) : "", image.height, image.width);
  // Samples begin at a multiple of 64 bytes; the dictionary ends with a line feed.
  const std::size_t header = (10 + dictionary.size() + 1 + 63) / 64 * 64;
  dictionary.append(header - 10 - dictionary.size() - 1, ' ');
  dictionary += '\n';
  bytes->assign(kMagic);
  bytes->append({'\1', '\0', static_cast<char>(dictionary.size() & 255),
                 static_cast<char>(dictionary.size() >> 8)});
  bytes->append(dictionary);
  for (const Image::Channel& c : image.channels) {
    bytes->append(reinterpret_cast<const char*>(c.values.data()), c.values.size() * sizeof(float));
  }
}

}  // namespace obscura::tools
