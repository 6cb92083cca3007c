#include "io/meshes/ply_header.h"

#include <fmt/format.h>

#include <array>

#include "io/meshes/words.h"

namespace obscura::tools {
namespace {

constexpr std::size_t kLongestHeader = 1 << 20, kMostElements = 64, kMostProperties = 512;

std::optional<PlyType> type_of(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return PlyType(i);
  }
  return {};
}

class HeaderReader {
 public:
  HeaderReader(const std::string& path, std::string_view bytes, PlyHeader* header)
      : path_(path), lines_(bytes.substr(0, kLongestHeader)), header_(*header) {}

  Status read() {
    std::string_view line;
    if (!lines_.next(&line) || line != "ply") return wrong("does not begin with 'ply'");
    bool format = false;
    while (lines_.next(&line)) {
      Words words(line);
      const std::string_view keyword = words.next();
      Status s;
      if (keyword == "end_header") {
        header_.body = lines_.position();
        return format ? Status() : wrong("has no line 'format'");
      }
      if (keyword == "format") {
        s = read_format(words.next());
        format = true;
      } else if (keyword == "element") {
        s = read_element(words);
      } else if (keyword == "property") {
        s = read_property(words);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        s = wrong(fmt::format("has '{}', which is no keyword of PLY", printable(keyword)));
      }
      if (!s.ok()) return s;
    }
    return wrong("has no line 'end_header'");
  }

 private:
  Status wrong(const std::string& what) const {
    return invalid_input(fmt::format("{}: its PLY header {}", path_, what));
  }

  Status read_format(std::string_view name) {
    if (name == "ascii") {
      header_.format = PlyHeader::Format::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyHeader::Format::kLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyHeader::Format::kBigEndian;
    } else {
      return wrong(
          fmt::format("has format '{}'; it must be ascii, binary_little_endian or "
                      "binary_big_endian",
                      printable(name)));
    }
    return {};
  }

  Status read_element(Words& words) {
    PlyElement e;
    e.name = words.next();
    const std::string_view count = words.next();
    if (e.name.empty() || !parse_number(count, &e.count)) {
      return wrong(fmt::format("has element '{}' with count '{}'; it must be a whole number",
                               printable(e.name), printable(count)));
    }
    if (header_.elements.size() == kMostElements) return wrong("has more than 64 elements");
    header_.elements.push_back(std::move(e));
    return {};
  }

  Status read_property(Words& words) {
    if (header_.elements.empty()) return wrong("has a property before any element");
    PlyElement& e = header_.elements.back();
    PlyProperty p;
    std::string_view type = words.next();
    if (type == "list") {
      const std::string_view count = words.next();
      p.count = type_of(count);
      if (!p.count || *p.count == PlyType::kF32 || *p.count == PlyType::kF64) {
        return wrong(fmt::format("has a list whose length is of type '{}'", printable(count)));
      }
      type = words.next();
    }
    const std::optional<PlyType> found = type_of(type);
    if (!found) return wrong(fmt::format("has a property of type '{}'", printable(type)));
    p.type = *found;
    p.name = words.next();
    if (e.properties.size() == kMostProperties) {
      return wrong(fmt::format("has more than 512 properties of '{}'", printable(e.name)));
    }
    e.properties.push_back(std::move(p));
    return {};
  }

  const std::string& path_;
  Lines lines_;
  PlyHeader& header_;
};

}  // namespace

std::uint64_t PlyElement::least_bytes(bool ascii) const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties) {
    bytes += ascii ? 2 : std::uint64_t(kPlyBytes[int(p.count.value_or(p.type))]);
  }
  return bytes;
}

Status read_ply_header(const std::string& path, std::string_view bytes, PlyHeader* header) {
  return HeaderReader(path, bytes, header).read();
}

}  // namespace obscura::tools
