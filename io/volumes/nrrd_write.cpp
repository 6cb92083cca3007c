#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "io/images/atomic_file.h"
#include "io/volumes/nrrd.h"

namespace obscura::tools {

std::string nrrd_field_header(const FieldGrid& grid, std::span<const std::string> names) {
  const bool many = names.size() > 1;
  auto vector = [](const Double3& v) { return fmt::format("({},{},{})", v[0], v[1], v[2]); };
  std::string header = "NRRD0005\n# Written by obscura\ntype: float\n";
  header += fmt::format("dimension: {}\n", many ? 4 : 3);
  header += "space: right-anterior-superior\n";
  header += fmt::format("sizes: {}{} {} {}\n", many ? fmt::format("{} ", names.size()) : "",
                        grid.size[0], grid.size[1], grid.size[2]);
  header += fmt::format("space directions: {}{} {} {}\n", many ? "none " : "", vector(grid.axes[0]),
                        vector(grid.axes[1]), vector(grid.axes[2]));
  header += fmt::format("kinds: {}domain domain domain\n", many ? "list " : "");
  header += std::endian::native == std::endian::little ? "endian: little\n" : "endian: big\n";
  header += "encoding: raw\n";
  header += fmt::format("space origin: {}\n", vector(grid.origin));
  for (std::size_t i = 0; i < names.size(); ++i) {
    header += fmt::format("field {}:={}\n", i, names[i]);
  }
  return header + "\n";
}

Status write_nrrd(const std::string& path, const FieldGrid& grid,
                  std::span<const NamedField> fields) {
  const bool many = fields.size() > 1;
  std::vector<std::string> names;
  for (const NamedField& field : fields) names.push_back(field.name);
  const std::string header = nrrd_field_header(grid, names);
  return write_atomically(path, [&](const std::string& temporary) -> Status {
    std::ofstream file(temporary, std::ios::binary);
    file << header;
    if (!many) {
      file.write(reinterpret_cast<const char*>(fields[0].values.data()),
                 std::streamsize(fields[0].values.size() * sizeof(float)));
    } else {
      const std::size_t row = std::size_t(grid.size[0]), channels = fields.size();
      std::vector<float> mixed(row * channels);
      for (std::size_t begin = 0; begin < fields[0].values.size() && file; begin += row) {
        for (std::size_t x = 0; x < row; ++x) {
          for (std::size_t c = 0; c < channels; ++c) {
            mixed[x * channels + c] = fields[c].values[begin + x];
          }
        }
        file.write(reinterpret_cast<const char*>(mixed.data()),
                   std::streamsize(mixed.size() * sizeof(float)));
      }
    }
    file.close();
    if (file) return {};
    return {StatusCode::kInternal,
            fmt::format("cannot write {}: {}", path, std::strerror(errno ? errno : EIO))};
  });
}

}  // namespace obscura::tools
