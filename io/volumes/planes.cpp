#include "io/volumes/planes.h"

#include <fmt/format.h>

#include <bit>

#include "io/images/files.h"
#include "io/volumes/nrrd.h"

namespace obscura::tools {
namespace {

StoredType stored_type(VoxelType type) {
  switch (type) {
    case VoxelType::kU8:
      return StoredType::kU8;
    case VoxelType::kI16:
      return StoredType::kI16;
    case VoxelType::kU16:
      return StoredType::kU16;
    case VoxelType::kF32:
      return StoredType::kF32;
  }
  return StoredType::kF32;
}

}  // namespace

Status PlaneFile::open(const std::string& path, const std::optional<RawLayout>& raw) {
  const std::string ending = file_ending(path);
  if (ending == ".raw") {
    if (raw) return open_raw(path, *raw);
    return invalid_argument(
        fmt::format("{}: a raw file does not say its layout; give its size and type", path));
  }
  if (ending != ".nrrd" && ending != ".nhdr") {
    return unsupported(fmt::format(
        "{}: planes can be read one by one of .raw, .nrrd and .nhdr files; convert it", path));
  }
  if (raw) {
    return invalid_argument(
        fmt::format("{}: says its own layout; size and type are for .raw files", path));
  }
  if (Status s = find_nrrd_planes(path, &volume_, &samples_); !s.ok()) return s;
  volume_.type = voxel_type_of(samples_.stored);
  volume_.stored_type = name_of(samples_.stored);
  return {};
}

Status PlaneFile::open_raw(const std::string& path, const RawLayout& layout) {
  ByteSource source;
  if (Status s = source.open(path, ByteSource::kPlain); !s.ok()) return s;
  volume_ = {};
  volume_.name = path;
  volume_.format = "raw";
  volume_.size = layout.size;
  for (int a = 0; a < 3; ++a) {
    volume_.axes[a] = {};
    volume_.axes[a][a] = layout.spacing[a];
  }
  if (Status s = check_geometry(volume_); !s.ok()) return s;
  const StoredType stored = stored_type(layout.type);
  const std::int64_t wanted = volume_.voxels() * std::int64_t(bytes_of(stored));
  if (wanted != source.most_bytes()) {
    return invalid_input(fmt::format("{}: has {} bytes; {}x{}x{} voxels of {} need exactly {}",
                                     path, source.most_bytes(), layout.size[0], layout.size[1],
                                     layout.size[2], name_of(stored), wanted));
  }
  volume_.type = layout.type;
  volume_.stored_type = name_of(stored);
  samples_ = {path, 0, stored, layout.big_endian != (std::endian::native == std::endian::big)};
  return {};
}

Status PlaneFile::read(int begin, int end, VolumeImage* slab) const {
  VolumeImage result = volume_;
  result.size[2] = end - begin;
  for (int k = 0; k < 3; ++k) result.origin[k] += begin * volume_.axes[2][k];
  const std::int64_t plane = std::int64_t{1} * volume_.size[0] * volume_.size[1];
  const std::int64_t at = samples_.offset + begin * plane * std::int64_t(bytes_of(samples_.stored));
  ByteSource source;
  if (Status s = source.open(samples_.file, ByteSource::kPlain, at); !s.ok()) return s;
  if (Status s = read_samples(source, samples_.stored, samples_.swap, &result); !s.ok()) return s;
  *slab = std::move(result);
  return {};
}

}  // namespace obscura::tools
