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
#include "io/volumes/nrrd_header.h"

namespace obscura::tools {
namespace {

std::string lower(std::string s) {
  for (char& c : s) c = char(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

bool stored_type(const std::string& name, StoredType* type) {
  // The format's own table ("Basic field specifications", type).
  static const std::pair<StoredType, std::vector<const char*>> kNames[] = {
      {StoredType::kI8, {"signed char", "int8", "int8_t"}},
      {StoredType::kU8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
      {StoredType::kI16,
       {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
      {StoredType::kU16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
      {StoredType::kI32, {"int", "signed int", "int32", "int32_t"}},
      {StoredType::kU32, {"uint", "unsigned int", "uint32", "uint32_t"}},
      {StoredType::kI64,
       {"longlong", "long long", "long long int", "signed long long", "signed long long int",
        "int64", "int64_t"}},
      {StoredType::kU64,
       {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
      {StoredType::kF32, {"float"}},
      {StoredType::kF64, {"double"}}};
  for (const auto& [stored, names] : kNames) {
    for (const char* n : names) {
      if (lower(name) != n) continue;
      *type = stored;
      return true;
    }
  }
  return false;
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
Status place(const std::string& path, const NrrdHeader& h, const std::vector<int>& kept,
             VolumeImage* image) {
  const std::string directions = h.get("space directions");
  if (directions.empty()) {
    std::istringstream in(h.get("spacings"));
    for (int axis = 0, a = 0; a < 3; ++axis) {
      std::string word;
      double s = 1;
      if (in >> word && lower(word) != "nan" && !parse_number(word, &s)) {
        return invalid_input(fmt::format("{}: its spacings are \"{}\"; they must be three numbers",
                                         path, h.get("spacings")));
      }
      if (axis != kept[a]) continue;
      image->axes[a] = {};
      image->axes[a][a] = s;
      ++a;
    }
    return {};
  }
  // A vector for each axis in space; "none" for the others, which are those of length one.
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

// The three axes that are not of length one, or the first three; `kept` says which they are.
Status parse_sizes(const std::string& path, const NrrdHeader& h, VolumeImage* image,
                   std::vector<int>* kept) {
  double dimension = 0;
  if (!parse_number(h.get("dimension"), &dimension) ||
      !(dimension >= 1 && dimension <= 16 && dimension == std::floor(dimension))) {
    return invalid_input(
        fmt::format("{}: its dimension is \"{:.40}\"; it must be 3", path, h.get("dimension")));
  }
  std::vector<int> sizes;
  std::istringstream in(h.get("sizes"));
  std::string word;
  while (in >> word) {
    double n = 0;
    if (!parse_number(word, &n) || !(n >= 1 && n <= 1e9 && n == std::floor(n))) n = -1;
    sizes.push_back(static_cast<int>(n));
  }
  if (sizes.size() != static_cast<std::size_t>(dimension) || std::ranges::count(sizes, -1) > 0) {
    return invalid_input(fmt::format("{}: its sizes are \"{:.80}\"; they must be {} numbers from 1",
                                     path, h.get("sizes"), dimension));
  }
  for (int a = 0; a < static_cast<int>(sizes.size()); ++a) {
    const int left = static_cast<int>(sizes.size()) - a;
    const bool spare = sizes[a] == 1 && left + static_cast<int>(kept->size()) > 3;
    if (!spare) kept->push_back(a);
  }
  if (kept->size() != 3) {
    return invalid_input(
        fmt::format("{}: its sizes are \"{:.80}\"; a single scalar volume has three axes longer "
                    "than one",
                    path, h.get("sizes")));
  }
  for (int a = 0; a < 3; ++a) image->size[a] = sizes[(*kept)[a]];
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

// One file's share of the samples.
Status read_slab(const std::string& path, const std::string& file, bool gzip, std::int64_t offset,
                 double lines, double skip, StoredType stored, bool swap, VolumeImage* slab) {
  ByteSource source;
  if (Status s = source.open(file, gzip ? ByteSource::kGunzip : ByteSource::kPlain, offset);
      !s.ok()) {
    return s;
  }
  if (skip == -1 && !gzip) {
    // The samples are the file's last bytes.
    skip = double(source.most_bytes()) - double(slab->voxels()) * double(bytes_of(stored));
    lines = 0;
  }
  if (skip > double(source.most_bytes())) {
    return invalid_input(fmt::format("{}: its byte skip is {}, beyond the data's end", path, skip));
  }
  if (Status s = skip_lines(source, std::int64_t(lines)); !s.ok()) return s;
  if (Status s = source.skip(std::int64_t(std::max(0.0, skip))); !s.ok()) return s;
  return read_samples(source, stored, swap, slab);
}

// Header, place and samples of a file.
struct Samples {
  std::vector<std::string> files;
  std::int64_t offset = 0;
  bool gzip = false, ascii = false, swap = false;
  double lines = 0, skip = 0;
  StoredType stored{};
};

Status describe(const std::string& path, VolumeImage* image, Samples* samples) {
  NrrdHeader h;
  if (Status s = read_nrrd_header(path, &h); !s.ok()) return s;
  VolumeImage result;
  result.name = path;
  result.format = "NRRD";
  std::vector<int> kept;
  if (Status s = parse_sizes(path, h, &result, &kept); !s.ok()) return s;
  if (!stored_type(h.get("type"), &samples->stored)) {
    return invalid_input(
        fmt::format("{}: its type is \"{}\"; it must be a scalar such as uchar, "
                    "short, float",
                    path, h.get("type")));
  }
  if (Status s = place(path, h, kept, &result); !s.ok()) return s;
  if (Status s = check_geometry(result); !s.ok()) return s;
  if (Status s = find_nrrd_data(path, h, &samples->files, &samples->offset); !s.ok()) return s;

  const std::string encoding = lower(h.get("encoding"));
  const std::string endian = lower(h.get("endian"));
  const bool raw = encoding == "raw";
  samples->gzip = encoding == "gzip" || encoding == "gz";
  samples->ascii = encoding == "ascii" || encoding == "text" || encoding == "txt";
  if (!raw && !samples->gzip && !samples->ascii) {
    return invalid_input(fmt::format("{}: its encoding is \"{}\"; it must be raw, gzip or ascii",
                                     path, h.get("encoding")));
  }
  if (!samples->ascii && bytes_of(samples->stored) > 1 && endian != "little" && endian != "big") {
    return invalid_input(
        fmt::format("{}: its endian is \"{}\"; it must be little or big", path, h.get("endian")));
  }
  samples->swap = (endian == "big") != (std::endian::native == std::endian::big);
  for (auto [key, value] :
       {std::pair{"line skip", &samples->lines}, std::pair{"byte skip", &samples->skip}}) {
    const std::string text = h.get(key);
    if (!text.empty() && (!parse_number(text, value) || !(*value >= -1 && *value < 1e15))) {
      return invalid_input(
          fmt::format("{}: its {} is \"{}\"; it must be a count", path, key, text));
    }
  }
  *image = std::move(result);
  return {};
}

}  // namespace

Status read_nrrd(const std::string& path, VolumeImage* image) {
  VolumeImage result;
  Samples samples;
  if (Status s = describe(path, &result, &samples); !s.ok()) return s;
  if (samples.ascii) {
    if (samples.files.size() > 1) {
      return invalid_input(fmt::format("{}: text samples in several files are not read", path));
    }
    if (Status s = read_ascii(samples.files[0], samples.offset, &result); !s.ok()) return s;
    result.stored_type = name_of(samples.stored);
    *image = std::move(result);
    return {};
  }
  const auto files = static_cast<int>(samples.files.size());
  if (result.size[2] % files != 0) {
    return invalid_input(
        fmt::format("{}: {} files cannot share its {} planes evenly", path, files, result.size[2]));
  }
  VolumeImage slab = result;
  slab.size[2] = result.size[2] / files;
  for (const std::string& file : samples.files) {
    slab.name = file;
    if (Status s = read_slab(path, file, samples.gzip, samples.offset, samples.lines, samples.skip,
                             samples.stored, samples.swap, &slab);
        !s.ok()) {
      return s;
    }
    if (files == 1) {
      result.samples = std::move(slab.samples);
    } else {
      result.samples.insert(result.samples.end(), slab.samples.begin(), slab.samples.end());
    }
  }
  result.type = slab.type;
  result.stored_type = slab.stored_type;
  result.slope = slab.slope;
  result.intercept = slab.intercept;
  *image = std::move(result);
  return {};
}

Status find_nrrd_planes(const std::string& path, VolumeImage* image, PlaneSamples* planes) {
  Samples samples;
  if (Status s = describe(path, image, &samples); !s.ok()) return s;
  const char* why = samples.gzip               ? "are compressed"
                    : samples.ascii            ? "are text"
                    : samples.files.size() > 1 ? "are in several files"
                    : samples.lines > 0        ? "begin after lines of text (line skip)"
                                               : nullptr;
  if (why) {
    return unsupported(fmt::format(
        "{}: its samples {}; planes can be read one by one of raw samples in one file", path, why));
  }
  planes->file = samples.files[0];
  planes->stored = samples.stored;
  planes->swap = samples.swap;
  planes->offset = samples.offset;
  const auto bytes = std::int64_t(bytes_of(samples.stored)) * image->voxels();
  std::error_code error;
  const auto length = std::int64_t(std::filesystem::file_size(planes->file, error));
  if (error) return invalid_input(fmt::format("cannot read {}: {}", planes->file, error.message()));
  // -1: the samples are the file's last bytes.
  planes->offset =
      samples.skip == -1 ? length - bytes : planes->offset + std::int64_t(samples.skip);
  if (planes->offset < 0 || length - planes->offset < bytes) {
    return invalid_input(fmt::format(
        "{}: its header promises {}x{}x{} samples of {}, {} bytes; the file holds at most {}", path,
        image->size[0], image->size[1], image->size[2], name_of(samples.stored), bytes,
        std::max<std::int64_t>(0, length - planes->offset)));
  }
  return {};
}

}  // namespace obscura::tools
