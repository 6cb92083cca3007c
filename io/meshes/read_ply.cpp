#include "io/meshes/read_ply.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "io/meshes/ply_header.h"
#include "io/meshes/words.h"

namespace obscura::tools {
namespace {

// Values of an ascii body, one word each.
class AsciiValues {
 public:
  explicit AsciiValues(std::string_view body) : words_(body) {}

  bool next(PlyType type, double* value) {
    word_ = words_.next();
    if (!parse_number(word_, value)) return false;
    // A number that is declared as a float is one, also where it is too large for it.
    if (type == PlyType::kF32) *value = static_cast<float>(*value);
    return true;
  }
  // The fewest bytes that a value of a list takes: a digit and what parts it from the next.
  static double least_bytes(PlyType) { return 2; }
  std::string failure() const {
    return word_.empty() ? "is cut short" : fmt::format("has '{}' for a number", printable(word_));
  }

 private:
  Words words_;
  std::string_view word_;
};

template <class T>
T decode(const char* bytes, bool swap) {
  char copy[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) copy[i] = bytes[swap ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

class BinaryValues {
 public:
  BinaryValues(std::string_view body, bool little)
      : body_(body), swap_(little != (std::endian::native == std::endian::little)) {}

  bool next(PlyType type, double* value) {
    const auto size = std::size_t(kPlyBytes[int(type)]);
    if (body_.size() - at_ < size) return false;
    *value = at(body_.data() + at_, type);
    at_ += size;
    return true;
  }
  static double least_bytes(PlyType type) { return kPlyBytes[int(type)]; }
  static std::string failure() { return "is cut short"; }

 private:
  double at(const char* p, PlyType type) const {
    switch (type) {
      case PlyType::kI8:
        return decode<std::int8_t>(p, swap_);
      case PlyType::kU8:
        return decode<std::uint8_t>(p, swap_);
      case PlyType::kI16:
        return decode<std::int16_t>(p, swap_);
      case PlyType::kU16:
        return decode<std::uint16_t>(p, swap_);
      case PlyType::kI32:
        return decode<std::int32_t>(p, swap_);
      case PlyType::kU32:
        return decode<std::uint32_t>(p, swap_);
      case PlyType::kF32:
        return decode<float>(p, swap_);
      case PlyType::kF64:
        break;
    }
    return decode<double>(p, swap_);
  }

  std::string_view body_;
  bool swap_;
  std::size_t at_ = 0;
};

template <class Values>
class BodyReader {
 public:
  BodyReader(const std::string& path, const PlyHeader& header, std::uint64_t body_bytes,
             Values values, MeshBuilder* builder)
      : path_(path),
        header_(header),
        body_bytes_(body_bytes),
        values_(values),
        builder_(*builder) {}

  Status read() {
    for (const PlyElement& e : header_.elements) {
      const std::uint64_t least = e.least_bytes(header_.format == PlyHeader::Format::kAscii);
      // The last number of an ascii file needs no end of line.
      if (least > 0 && e.count > (body_bytes_ + 1) / least) {
        return wrong(
            fmt::format("is cut short: its header promises {} of '{}', for which {} bytes "
                        "are too few",
                        e.count, printable(e.name), body_bytes_));
      }
      if (Status s = read_element(e); !s.ok()) return s;
    }
    return check_corners();
  }

 private:
  struct Axes {
    int of[3] = {-1, -1, -1};  // properties that are x, y, z
    bool complete() const { return of[0] >= 0 && of[1] >= 0 && of[2] >= 0; }
  };

  Status wrong(const std::string& what) const {
    return invalid_input(fmt::format("{}: {}", path_, what));
  }
  Status failed(const PlyElement& e, std::uint64_t index) const {
    return wrong(fmt::format("{} in '{}' {}", values_.failure(), printable(e.name), index));
  }

  Status read_element(const PlyElement& e) {
    const bool vertices = e.name == "vertex", strips = e.name == "tristrips";
    Axes axes;
    int corners = -1;
    bool single = false;
    for (int i = 0; i < int(e.properties.size()); ++i) {
      const PlyProperty& p = e.properties[std::size_t(i)];
      for (int k = 0; k < 3 && vertices && !p.count; ++k) {
        if (p.name != std::string(1, char('x' + k))) continue;
        axes.of[k] = i;
        single = p.type == PlyType::kF32;
      }
      const bool names_corners = p.name == "vertex_indices" || p.name == "vertex_index";
      if ((e.name == "face" || strips) && p.count && names_corners) corners = i;
    }
    if (vertices && !axes.complete()) return wrong("its vertices have no x, y and z");
    if (vertices) builder_.reserve(std::size_t(e.count), 0);
    for (std::uint64_t index = 0; index < e.count && !e.properties.empty(); ++index) {
      double position[3] = {};
      for (int i = 0; i < int(e.properties.size()); ++i) {
        const PlyProperty& p = e.properties[std::size_t(i)];
        if (p.count) {
          if (Status s = read_list(e, p, index, i == corners); !s.ok()) return s;
          continue;
        }
        double value = 0;
        if (!values_.next(p.type, &value)) return failed(e, index);
        for (int k = 0; k < 3; ++k) {
          if (axes.of[k] == i) position[k] = value;
        }
      }
      if (vertices) builder_.add_vertex({position[0], position[1], position[2]}, single);
      if (corners >= 0) pending_.push_back({corners_.size(), strips});
    }
    return {};
  }

  // Corners are kept until all vertices are known: elements stand in any order.
  Status read_list(const PlyElement& e, const PlyProperty& p, std::uint64_t index, bool keep) {
    double length = 0;
    if (!values_.next(*p.count, &length)) return failed(e, index);
    // In double, which a length of 1e300 does not overflow.
    if (!(length >= 0 && length * Values::least_bytes(p.type) <= double(body_bytes_) + 1)) {
      return wrong(fmt::format("'{}' {} has a list of {:.15g} entries, more than the file holds",
                               printable(e.name), index, length));
    }
    for (std::uint64_t i = 0; i < std::uint64_t(length); ++i) {
      double value = 0;
      if (!values_.next(p.type, &value)) return failed(e, index);
      if (keep) corners_.push_back(value);
    }
    return {};
  }

  Status check_corners() {
    std::size_t first = 0;
    std::vector<std::uint32_t> polygon;
    for (std::size_t f = 0; f < pending_.size(); ++f) {
      const auto [end, strip] = pending_[f];
      polygon.clear();
      for (std::size_t i = first; i < end; ++i) {
        const double corner = corners_[i];
        if (strip && corner == -1) {
          add_strip(polygon);
          polygon.clear();
          continue;
        }
        if (!(corner >= 0 && corner < double(builder_.vertex_count()))) {
          return wrong(fmt::format("face {} names vertex {:.15g} of {}", f, corner,
                                   builder_.vertex_count()));
        }
        polygon.push_back(std::uint32_t(corner));
      }
      strip ? add_strip(polygon) : builder_.add_polygon(polygon);
      first = end;
    }
    return {};
  }

  void add_strip(const std::vector<std::uint32_t>& s) {
    for (std::size_t i = 0; i + 2 < s.size(); ++i) {
      builder_.add_triangle(s[i], s[i + 1 + i % 2], s[i + 2 - i % 2]);
    }
  }

  struct Pending {
    std::size_t end;  // of its corners
    bool strip;
  };

  const std::string& path_;
  const PlyHeader& header_;
  const std::uint64_t body_bytes_;
  Values values_;
  MeshBuilder& builder_;
  std::vector<double> corners_;
  std::vector<Pending> pending_;
};

}  // namespace

Status read_ply(const std::string& path, std::string_view bytes, MeshBuilder* builder) {
  PlyHeader header;
  if (Status s = read_ply_header(path, bytes, &header); !s.ok()) return s;
  const std::string_view body = bytes.substr(header.body);
  if (header.format == PlyHeader::Format::kAscii) {
    return BodyReader(path, header, body.size(), AsciiValues(body), builder).read();
  }
  const bool little = header.format == PlyHeader::Format::kLittleEndian;
  return BodyReader(path, header, body.size(), BinaryValues(body, little), builder).read();
}

}  // namespace obscura::tools
