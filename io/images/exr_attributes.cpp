#include <cstdint>
#include <fstream>

#include "io/images/exr_native.h"

namespace obscura::tools {
namespace {

// Types of which OpenEXR reads as many bytes as it knows, whatever the size says.
constexpr struct {
  const char* type;
  std::int64_t size;
} kFixedSizes[] = {
    {"box2f", 16},      {"box2i", 16},    {"chromaticities", 32},
    {"compression", 1}, {"double", 8},    {"deepImageState", 1},
    {"envmap", 1},      {"float", 4},     {"int", 4},
    {"keycode", 28},    {"lineOrder", 1}, {"m33d", 72},
    {"m33f", 36},       {"m44d", 128},    {"m44f", 64},
    {"rational", 8},    {"tiledesc", 9},  {"timecode", 8},
    {"v2d", 16},        {"v2f", 8},       {"v2i", 8},
    {"v3d", 24},        {"v3f", 12},      {"v3i", 12},
};

class HeaderWalk {
 public:
  explicit HeaderWalk(const std::string& path) : in_(path, std::ios::binary | std::ios::ate) {
    length_ = in_.tellg();
    in_.seekg(0);
  }

  // Null where all is well, or what is wrong.
  const char* check() {
    unsigned char start[8] = {};
    in_.read(reinterpret_cast<char*>(start), 8);
    if (!in_ || start[0] != 0x76 || start[1] != 0x2f || start[2] != 0x31 || start[3] != 0x01) {
      return "it does not begin like one";
    }
    const bool multi_part = (start[5] & 0x10) != 0;
    for (bool any_part = false;; any_part = true) {
      for (bool any_attribute = false;; any_attribute = true) {
        std::string name;
        if (!read_name(&name)) return kDamaged;
        if (name.empty() && !any_attribute && any_part) return nullptr;  // no further part
        if (name.empty()) break;
        if (!check_attribute()) return kDamaged;
      }
      if (!multi_part) return nullptr;
    }
  }

 private:
  static constexpr const char* kDamaged = "truncated or damaged in its header";

  bool read_name(std::string* name) {
    name->clear();
    for (int c = in_.get(); c > 0 && name->size() < 256; c = in_.get()) {
      name->push_back(static_cast<char>(c));
    }
    return in_.good() && name->size() < 256;
  }

  bool read_int(std::int64_t* value) {
    unsigned char b[4] = {};
    in_.read(reinterpret_cast<char*>(b), 4);
    *value = b[0] | b[1] << 8 | b[2] << 16 | std::int64_t{b[3]} << 24;
    return in_.good();
  }

  bool check_attribute() {
    std::string type;
    std::int64_t size;
    if (!read_name(&type) || !read_int(&size) || size > length_ - in_.tellg()) return false;
    for (const auto& fixed : kFixedSizes) {
      if (type == fixed.type && size != fixed.size) return false;
    }
    const std::int64_t end = in_.tellg() + std::streamoff(size);
    if (type == "chlist" && !check_channels(end)) return false;
    if (type == "preview") {
      std::int64_t width, height;
      if (size < 8 || !read_int(&width) || !read_int(&height)) return false;
      if (width * 4 > size || width * height * 4 != size - 8) return false;
    }
    in_.seekg(end);
    return true;
  }

  // Names with 16 bytes each, up to an empty name at `end`.
  bool check_channels(std::int64_t end) {
    for (;;) {
      std::string name;
      if (!read_name(&name)) return false;
      if (name.empty()) return in_.tellg() == end;
      in_.seekg(16, std::ios::cur);
      if (in_.tellg() >= end) return false;
    }
  }

  std::ifstream in_;
  std::int64_t length_;
};

}  // namespace

Status check_exr_attributes(const std::string& path) {
  if (const char* what = HeaderWalk(path).check()) {
    return invalid_input(fmt::format("{}: not a readable EXR file ({})", path, what));
  }
  return {};
}

}  // namespace obscura::tools
