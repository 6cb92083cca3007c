#include "io/volumes/nifti.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/volumes/byte_source.h"

namespace obscura::tools {
namespace {

constexpr int kSize1 = 348, kSize2 = 540;  // of the headers, as their first field says

// The fields that we need, of either version.
struct Header {
  std::int64_t dim[8] = {};
  int datatype = 0;
  double pixdim[8] = {};
  double vox_offset = 0, slope = 0, intercept = 0;
  int qform = 0, sform = 0;
  double quatern[3] = {}, qoffset[3] = {};
  double srow[3][4] = {};
};

class Fields {
 public:
  Fields(const std::byte* bytes, bool swap) : bytes_(bytes), swap_(swap) {}

  template <class T>
  T get(int offset) const {
    std::byte field[sizeof(T)];
    std::memcpy(field, bytes_ + offset, sizeof(T));
    if (swap_) std::reverse(field, field + sizeof(T));
    T value;
    std::memcpy(&value, field, sizeof(T));
    return value;
  }

 private:
  const std::byte* bytes_;
  bool swap_;
};

Header header1(const Fields& f) {
  Header h;
  for (int i = 0; i < 8; ++i) h.dim[i] = f.get<std::int16_t>(40 + 2 * i);
  h.datatype = f.get<std::int16_t>(70);
  for (int i = 0; i < 8; ++i) h.pixdim[i] = f.get<float>(76 + 4 * i);
  h.vox_offset = f.get<float>(108);
  h.slope = f.get<float>(112);
  h.intercept = f.get<float>(116);
  h.qform = f.get<std::int16_t>(252);
  h.sform = f.get<std::int16_t>(254);
  for (int i = 0; i < 3; ++i) h.quatern[i] = f.get<float>(256 + 4 * i);
  for (int i = 0; i < 3; ++i) h.qoffset[i] = f.get<float>(268 + 4 * i);
  for (int i = 0; i < 12; ++i) h.srow[i / 4][i % 4] = f.get<float>(280 + 4 * i);
  return h;
}

Header header2(const Fields& f) {
  Header h;
  h.datatype = f.get<std::int16_t>(12);
  for (int i = 0; i < 8; ++i) h.dim[i] = f.get<std::int64_t>(16 + 8 * i);
  for (int i = 0; i < 8; ++i) h.pixdim[i] = f.get<double>(104 + 8 * i);
  h.vox_offset = static_cast<double>(f.get<std::int64_t>(168));
  h.slope = f.get<double>(176);
  h.intercept = f.get<double>(184);
  h.qform = f.get<std::int32_t>(344);
  h.sform = f.get<std::int32_t>(348);
  for (int i = 0; i < 3; ++i) h.quatern[i] = f.get<double>(352 + 8 * i);
  for (int i = 0; i < 3; ++i) h.qoffset[i] = f.get<double>(376 + 8 * i);
  for (int i = 0; i < 12; ++i) h.srow[i / 4][i % 4] = f.get<double>(400 + 8 * i);
  return h;
}

bool stored_type(int datatype, StoredType* type) {
  switch (datatype) {
    case 2:
      *type = StoredType::kU8;
      return true;
    case 4:
      *type = StoredType::kI16;
      return true;
    case 8:
      *type = StoredType::kI32;
      return true;
    case 16:
      *type = StoredType::kF32;
      return true;
    case 64:
      *type = StoredType::kF64;
      return true;
    case 256:
      *type = StoredType::kI8;
      return true;
    case 512:
      *type = StoredType::kU16;
      return true;
    case 768:
      *type = StoredType::kU32;
      return true;
    case 1024:
      *type = StoredType::kI64;
      return true;
    case 1280:
      *type = StoredType::kU64;
      return true;
    default:
      return false;
  }
}

void place_by_sform(const Header& h, VolumeImage* image) {
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) image->axes[a][k] = h.srow[k][a];
    image->origin[a] = h.srow[a][3];
  }
}

// Rotation from the quaternion (a, b, c, d) of unit length; pixdim[0] < 0 flips the z axis.
void place_by_qform(const Header& h, VolumeImage* image) {
  double b = h.quatern[0], c = h.quatern[1], d = h.quatern[2];
  double a = 1 - (b * b + c * c + d * d);
  if (a < 1e-7) {
    const double length = std::sqrt(b * b + c * c + d * d);
    b /= length, c /= length, d /= length, a = 0;
  } else {
    a = std::sqrt(a);
  }
  const double r[3][3] = {
      {a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
      {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)},
      {2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c}};
  for (int axis = 0; axis < 3; ++axis) {
    const double flip = axis == 2 && h.pixdim[0] < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) {
      image->axes[axis][k] = flip * std::abs(h.pixdim[axis + 1]) * r[k][axis];
    }
    image->origin[axis] = h.qoffset[axis];
  }
}

void place_by_spacing(const Header& h, VolumeImage* image) {
  for (int a = 0; a < 3; ++a) {
    image->axes[a] = {};
    // An axis of one voxel needs no spacing, and writers leave it 0.
    const bool unset = h.pixdim[a + 1] == 0 && image->size[a] == 1;
    image->axes[a][a] = unset ? 1 : std::abs(h.pixdim[a + 1]);
  }
}

Status place(const Header& h, VolumeImage* image) {
  if (h.sform > 0) {
    place_by_sform(h, image);
    if (h.qform <= 0 || check_geometry(*image).ok()) return {};
  }
  if (h.qform > 0) {
    place_by_qform(h, image);
    return {};
  }
  place_by_spacing(h, image);
  return {};
}

Status read_header(ByteSource& source, const std::string& path, Header* header, bool* swap,
                   int* header_bytes) {
  std::byte bytes[kSize2];
  if (Status s = source.read(bytes, kSize1); !s.ok()) return s;
  const auto first = Fields(bytes, false).get<std::int32_t>(0);
  const auto swapped = Fields(bytes, true).get<std::int32_t>(0);
  *swap = swapped == kSize1 || swapped == kSize2;
  const int size = *swap ? swapped : first;
  if (size != kSize1 && size != kSize2) {
    return invalid_input(
        fmt::format("{}: is not NIfTI; its first number is {} and must be {} or {}", path, first,
                    kSize1, kSize2));
  }
  const auto* magic = reinterpret_cast<const char*>(bytes) + (size == kSize1 ? 344 : 4);
  if (std::memcmp(magic, size == kSize1 ? "n+1" : "n+2", 4) != 0) {
    return invalid_input(fmt::format(
        "{}: its magic is not that of NIfTI in one file (n+1, n+2); join header and image", path));
  }
  if (size == kSize2) {
    if (Status s = source.read(bytes + kSize1, kSize2 - kSize1); !s.ok()) return s;
  }
  const Fields fields(bytes, *swap);
  *header = size == kSize1 ? header1(fields) : header2(fields);
  *header_bytes = size;
  return {};
}

}  // namespace

Status read_nifti(const std::string& path, int index, VolumeImage* image) {
  ByteSource source;
  if (Status s = source.open(path, ByteSource::kGunzip); !s.ok()) return s;
  Header h;
  bool swap = false;
  int header_bytes = 0;
  if (Status s = read_header(source, path, &h, &swap, &header_bytes); !s.ok()) return s;

  if (h.dim[0] < 1 || h.dim[0] > 7) {
    return invalid_input(fmt::format("{}: its dim[0] is {}; it must be in [1, 7]", path, h.dim[0]));
  }
  VolumeImage result;
  result.name = path;
  result.format = header_bytes == kSize1 ? "NIfTI-1" : "NIfTI-2";
  double volumes = 1;
  for (int i = 1; i <= 7; ++i) {
    const std::int64_t n = i <= h.dim[0] ? h.dim[i] : 1;
    if (i <= 3) {
      result.size[i - 1] = int(std::clamp<std::int64_t>(n, -1, 1 << 30));
    } else if (n < 1 || n > 32767 || volumes > 1e9 / static_cast<double>(n)) {
      return invalid_input(
          fmt::format("{}: its dim[{}] is {}; it must be at least 1, and no more "
                      "than a billion volumes be in all",
                      path, i, n));
    } else {
      volumes *= static_cast<double>(n);
    }
  }
  if (index < 0 || index >= volumes) {
    return invalid_argument(
        fmt::format("--volume-index is {}; {} has {} volumes, from 0 on", index, path, volumes));
  }
  if (volumes > 1) {
    result.notes.push_back(fmt::format("{}: of its {} volumes, number {} is read (--volume-index)",
                                       path, volumes, index));
  }
  StoredType stored;
  if (!stored_type(h.datatype, &stored)) {
    return invalid_input(fmt::format(
        "{}: its datatype is {}; it must be a scalar one of 8 to 64 bits", path, h.datatype));
  }
  if (!(h.vox_offset >= header_bytes && h.vox_offset <= 1e15)) {
    // Zero means right after the header and its four bytes of extension.
    if (h.vox_offset != 0) {
      return invalid_input(fmt::format("{}: its vox_offset is {}; it must be at least {}", path,
                                       h.vox_offset, header_bytes));
    }
    h.vox_offset = header_bytes + 4;
  }
  if (h.slope != 0 && std::isfinite(h.slope) && std::isfinite(h.intercept)) {
    result.slope = float(h.slope);
    result.intercept = float(h.intercept);
  }
  if (Status s = place(h, &result); !s.ok()) return s;
  if (Status s = check_geometry(result); !s.ok()) return s;
  const double before = static_cast<double>(index) * static_cast<double>(result.voxels()) *
                        static_cast<double>(bytes_of(stored));
  const double skipped = h.vox_offset - header_bytes + before;
  if (skipped > static_cast<double>(source.most_bytes())) {
    return invalid_input(fmt::format("{}: its volume {} begins at byte {:.0f}, beyond its end",
                                     path, index, h.vox_offset + before));
  }
  if (Status s = source.skip(static_cast<std::int64_t>(skipped)); !s.ok()) return s;
  if (Status s = read_samples(source, stored, swap, &result); !s.ok()) return s;
  *image = std::move(result);
  return {};
}

}  // namespace obscura::tools
