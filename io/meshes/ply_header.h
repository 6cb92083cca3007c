#ifndef OBSCURA_IO_MESHES_PLY_HEADER_H_
#define OBSCURA_IO_MESHES_PLY_HEADER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obscura/status.h"

namespace obscura::tools {

enum class PlyType { kI8, kU8, kI16, kU16, kI32, kU32, kF32, kF64 };
inline constexpr int kPlyBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kF32;
  std::optional<PlyType> count{};  // of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // The fewest bytes that one of them takes in a file.
  std::uint64_t least_bytes(bool ascii) const;
};

struct PlyHeader {
  enum class Format { kAscii, kLittleEndian, kBigEndian } format = Format::kAscii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  // where the header ends, in bytes
};

// Reads the header: comments may stand anywhere in it, lines end in \n or \r\n.
Status read_ply_header(const std::string& path, std::string_view bytes, PlyHeader* header);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_PLY_HEADER_H_
