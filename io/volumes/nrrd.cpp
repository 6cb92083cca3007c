#include "io/volumes/nrrd.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "io/images/atomic_file.h"
#include "io/volumes/byte_source.h"

namespace obscura::tools {
namespace {

constexpr std::int64_t kMostHeader = 1 << 20;

std::string trimmed(const std::string& s) {
  const std::size_t begin = s.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return s.substr(begin, s.find_last_not_of(" \t\r") - begin + 1);
}

std::string lower(std::string s) {
  for (char& c : s) c = char(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

struct Header {
  std::map<std::string, std::string> fields;  // keys in lower case
  std::int64_t end = 0;                       // position after the blank line

  std::string get(const std::string& key) const {
    const auto at = fields.find(key);
    return at == fields.end() ? "" : at->second;
  }
};

Status read_header(const std::string& path, Header* header) {
  if (Status s = check_readable(path); !s.ok()) return s;
  std::ifstream file(path, std::ios::binary);
  std::string line(8, '\0');
  file.read(line.data(), 8);
  if (!file || line.substr(0, 7) != "NRRD000") {
    return invalid_input(fmt::format("{}: is not NRRD; it does not begin with NRRD000", path));
  }
  std::getline(file, line);
  std::int64_t total = 0;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) {
      header->end = file.tellg();
      return {};
    }
    total += std::int64_t(line.size());
    if (total > kMostHeader) break;
    if (line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) {
      return invalid_input(
          fmt::format("{}: its header has a line without a colon: \"{:.60}\"", path, line));
    }
    if (colon + 1 < line.size() && line[colon + 1] == '=') continue;  // the user's own
    header->fields[lower(trimmed(line.substr(0, colon)))] = trimmed(line.substr(colon + 1));
  }
  header->end = -1;  // allowed where the data lie elsewhere
  return {};
}

bool stored_type(const std::string& name, StoredType* type) {
  static const std::map<std::string, StoredType> kTypes = {
      {"uchar", StoredType::kU8},       {"unsigned char", StoredType::kU8},
      {"uint8", StoredType::kU8},       {"uint8_t", StoredType::kU8},
      {"signed char", StoredType::kI8}, {"int8", StoredType::kI8},
      {"int8_t", StoredType::kI8},      {"short", StoredType::kI16},
      {"short int", StoredType::kI16},  {"signed short", StoredType::kI16},
      {"int16", StoredType::kI16},      {"int16_t", StoredType::kI16},
      {"ushort", StoredType::kU16},     {"unsigned short", StoredType::kU16},
      {"uint16", StoredType::kU16},     {"uint16_t", StoredType::kU16},
      {"int", StoredType::kI32},        {"signed int", StoredType::kI32},
      {"int32", StoredType::kI32},      {"int32_t", StoredType::kI32},
      {"uint", StoredType::kU32},       {"unsigned int", StoredType::kU32},
      {"uint32", StoredType::kU32},     {"uint32_t", StoredType::kU32},
      {"longlong", StoredType::kI64},   {"long long", StoredType::kI64},
      {"int64", StoredType::kI64},      {"int64_t", StoredType::kI64},
      {"ulonglong", StoredType::kU64},  {"unsigned long long", StoredType::kU64},
      {"uint64", StoredType::kU64},     {"uint64_t", StoredType::kU64},
      {"float", StoredType::kF32},      {"double", StoredType::kF64}};
  const auto at = kTypes.find(lower(name));
  if (at == kTypes.end()) return false;
  *type = at->second;
  return true;
}

// "(1,2,3)" from position `at` on, which moves behind it.
bool parse_vector(const std::string& text, std::size_t* at, Double3* v) {
  const std::size_t open = text.find('(', *at), close = text.find(')', *at);
  if (open == std::string::npos || close == std::string::npos || close < open) return false;
  std::istringstream in(text.substr(open + 1, close - open - 1));
  char comma = ',';
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && (!(in >> comma) || comma != ',')) return false;
    if (!(in >> (*v)[k])) return false;
  }
  *at = close + 1;
  return (in >> std::ws).eof();
}

// World axes from `space directions`, or bare `spacings`.
Status place(const std::string& path, const Header& h, VolumeImage* image) {
  const std::string directions = h.get("space directions");
  if (directions.empty()) {
    std::istringstream in(h.get("spacings"));
    for (int a = 0; a < 3; ++a) {
      std::string word;
      double s = 1;
      if (in >> word && lower(word) != "nan" && !parse_number(word, &s)) {
        return invalid_input(fmt::format("{}: its spacings are \"{}\"; they must be three numbers",
                                         path, h.get("spacings")));
      }
      image->axes[a] = {};
      image->axes[a][a] = s;
    }
    return {};
  }
  std::size_t at = 0;
  for (int a = 0; a < 3; ++a) {
    if (!parse_vector(directions, &at, &image->axes[a])) {
      return invalid_input(
          fmt::format("{}: its space directions are \"{:.80}\"; they must be three vectors (x,y,z)",
                      path, directions));
    }
  }
  at = 0;
  const std::string origin = h.get("space origin");
  if (!origin.empty() && !parse_vector(origin, &at, &image->origin)) {
    return invalid_input(fmt::format(
        "{}: its space origin is \"{:.80}\"; it must be a vector (x,y,z)", path, origin));
  }
  const std::string space = lower(h.get("space"));
  auto negate = [&](int k) {
    for (Double3& axis : image->axes) axis[k] = -axis[k];
    image->origin[k] = -image->origin[k];
  };
  const bool lps = space == "lps" || space == "left-posterior-superior";
  const bool las = space == "las" || space == "left-anterior-superior";
  if (lps || las) negate(0);
  if (lps) negate(1);
  if (space == "3d-left-handed" || space == "3dlh") negate(2);
  return {};
}

Status parse_sizes(const std::string& path, const Header& h, VolumeImage* image) {
  if (h.get("dimension") != "3") {
    return invalid_input(
        fmt::format("{}: its dimension is \"{}\"; it must be 3, a single scalar volume", path,
                    h.get("dimension")));
  }
  std::istringstream in(h.get("sizes"));
  for (int& n : image->size) {
    if (!(in >> n)) n = -1;
  }
  std::string more;
  if (in >> more) image->size[0] = -1;
  if (*std::min_element(image->size.begin(), image->size.end()) < 1) {
    return invalid_input(
        fmt::format("{}: its sizes are \"{:.80}\"; they must be three numbers "
                    "from 1",
                    path, h.get("sizes")));
  }
  return {};
}

Status read_ascii(const std::string& path, std::int64_t offset, VolumeImage* image) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(0, std::ios::end);
  // A sample takes two characters at least, the last one only one.
  const std::int64_t most = (std::int64_t(file.tellg()) - offset + 1) / 2;
  if (image->voxels() > most) {
    return invalid_input(
        fmt::format("{}: its header promises {} samples; the file holds at most "
                    "{}",
                    path, image->voxels(), most));
  }
  file.seekg(offset);
  image->type = VoxelType::kF32;
  image->samples.resize(std::size_t(image->voxels()) * sizeof(float));
  auto* values = reinterpret_cast<float*>(image->samples.data());
  std::string word;
  for (std::int64_t i = 0; i < image->voxels(); ++i) {
    double v = 0;
    const bool got = bool(file >> word);
    const bool nan = got && lower(word) == "nan";
    if (!got || (!nan && !parse_number(word, &v))) {
      return invalid_input(fmt::format("{}: its sample {} of {} is {}", path, i, image->voxels(),
                                       got ? "not a number" : "missing"));
    }
    values[i] = nan ? std::nanf("") : float(v);
  }
  return {};
}

Status skip_lines(ByteSource& source, std::int64_t lines) {
  while (lines > 0) {
    char c = 0;
    if (Status s = source.read(&c, 1); !s.ok()) return s;
    lines -= c == '\n';
  }
  return {};
}

// Where the samples begin: the file, and the position in it.
Status find_data(const std::string& path, const Header& h, std::string* data,
                 std::int64_t* offset) {
  std::string name = h.get("data file");
  if (name.empty()) name = h.get("datafile");
  if (name.empty()) {
    if (h.end < 0) {
      return invalid_input(
          fmt::format("{}: its header has no end; a blank line or a data file is missing", path));
    }
    *data = path;
    *offset = h.end;
    return {};
  }
  if (name.starts_with("LIST") || name.find('%') != std::string::npos) {
    return invalid_input(
        fmt::format("{}: its data file is \"{:.80}\"; it must be a single file", path, name));
  }
  *data = (std::filesystem::path(path).parent_path() / name).string();
  *offset = 0;
  return {};
}

}  // namespace

Status read_nrrd(const std::string& path, VolumeImage* image) {
  Header h;
  if (Status s = read_header(path, &h); !s.ok()) return s;
  VolumeImage result;
  result.name = path;
  result.format = "NRRD";
  if (Status s = parse_sizes(path, h, &result); !s.ok()) return s;
  StoredType stored;
  if (!stored_type(h.get("type"), &stored)) {
    return invalid_input(
        fmt::format("{}: its type is \"{}\"; it must be a scalar such as uchar, "
                    "short, float",
                    path, h.get("type")));
  }
  if (Status s = place(path, h, &result); !s.ok()) return s;
  if (Status s = check_geometry(result); !s.ok()) return s;
  std::string data;
  std::int64_t offset = 0;
  if (Status s = find_data(path, h, &data, &offset); !s.ok()) return s;

  const std::string encoding = lower(h.get("encoding"));
  const std::string endian = lower(h.get("endian"));
  const bool raw = encoding == "raw", gzip = encoding == "gzip" || encoding == "gz";
  const bool ascii = encoding == "ascii" || encoding == "text" || encoding == "txt";
  if (!raw && !gzip && !ascii) {
    return invalid_input(fmt::format("{}: its encoding is \"{}\"; it must be raw, gzip or ascii",
                                     path, h.get("encoding")));
  }
  if (!ascii && bytes_of(stored) > 1 && endian != "little" && endian != "big") {
    return invalid_input(
        fmt::format("{}: its endian is \"{}\"; it must be little or big", path, h.get("endian")));
  }
  double lines = 0, skip = 0;
  for (auto [key, value] : {std::pair{"line skip", &lines}, std::pair{"byte skip", &skip}}) {
    const std::string text = h.get(key);
    if (!text.empty() && (!parse_number(text, value) || !(*value >= -1 && *value < 1e15))) {
      return invalid_input(
          fmt::format("{}: its {} is \"{}\"; it must be a count", path, key, text));
    }
  }
  ByteSource source;
  if (Status s = source.open(data, gzip ? ByteSource::kGunzip : ByteSource::kPlain, offset);
      !s.ok()) {
    return s;
  }
  if (ascii) {
    if (Status s = read_ascii(data, offset, &result); !s.ok()) return s;
    result.stored_type = name_of(stored);
    *image = std::move(result);
    return {};
  }
  if (skip == -1 && raw) {
    // The samples are the file's last bytes.
    skip = double(source.most_bytes()) - double(result.voxels()) * double(bytes_of(stored));
    lines = 0;
  }
  if (skip > double(source.most_bytes())) {
    return invalid_input(fmt::format("{}: its byte skip is {}, beyond the data's end", path, skip));
  }
  if (Status s = skip_lines(source, std::int64_t(lines)); !s.ok()) return s;
  if (Status s = source.skip(std::int64_t(std::max(0.0, skip))); !s.ok()) return s;
  const bool swap = (endian == "big") != (std::endian::native == std::endian::big);
  if (Status s = read_samples(source, stored, swap, &result); !s.ok()) return s;
  *image = std::move(result);
  return {};
}

Status write_nrrd(const std::string& path, const FieldGrid& grid,
                  std::span<const NamedField> fields) {
  const bool many = fields.size() > 1;
  auto vector = [](const Double3& v) { return fmt::format("({},{},{})", v[0], v[1], v[2]); };
  std::string header = "NRRD0005\n# Written by obscura\ntype: float\n";
  header += fmt::format("dimension: {}\n", many ? 4 : 3);
  header += "space: right-anterior-superior\n";
  header += fmt::format("sizes: {}{} {} {}\n", many ? fmt::format("{} ", fields.size()) : "",
                        grid.size[0], grid.size[1], grid.size[2]);
  header += fmt::format("space directions: {}{} {} {}\n", many ? "none " : "", vector(grid.axes[0]),
                        vector(grid.axes[1]), vector(grid.axes[2]));
  header += fmt::format("kinds: {}domain domain domain\n", many ? "list " : "");
  header += std::endian::native == std::endian::little ? "endian: little\n" : "endian: big\n";
  header += "encoding: raw\n";
  header += fmt::format("space origin: {}\n", vector(grid.origin));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    header += fmt::format("field {}:={}\n", i, fields[i].name);
  }
  header += "\n";
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
