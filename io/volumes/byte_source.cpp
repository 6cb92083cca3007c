#include "io/volumes/byte_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "io/images/atomic_file.h"

namespace obscura::tools {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

template <class T>
void to_float(const std::byte* bytes, std::size_t count, float* values) {
  for (std::size_t i = 0; i < count; ++i) {
    T v;
    std::memcpy(&v, bytes + i * sizeof(T), sizeof(T));
    values[i] = static_cast<float>(v);
  }
}

void to_float(StoredType type, const std::byte* bytes, std::size_t count, float* values) {
  switch (type) {
    case StoredType::kI8:
      return to_float<std::int8_t>(bytes, count, values);
    case StoredType::kU32:
      return to_float<std::uint32_t>(bytes, count, values);
    case StoredType::kI32:
      return to_float<std::int32_t>(bytes, count, values);
    case StoredType::kU64:
      return to_float<std::uint64_t>(bytes, count, values);
    case StoredType::kI64:
      return to_float<std::int64_t>(bytes, count, values);
    case StoredType::kF64:
      // What a float cannot hold becomes infinite.
      return to_float<double>(bytes, count, values);
    default:
      return;  // kept as stored
  }
}

void swap_bytes(std::byte* bytes, std::size_t width, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::reverse(bytes + i * width, bytes + (i + 1) * width);
  }
}

}  // namespace

ByteSource::~ByteSource() {
  if (gzip_) {
    gzclose(gzip_);
  } else if (file_ >= 0) {
    close(file_);
  }
}

Status ByteSource::open(const std::string& path, Mode mode, std::int64_t offset) {
  if (Status s = check_readable(path); !s.ok()) return s;
  path_ = path;
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat info = {};
  if (file_ < 0 || fstat(file_, &info) != 0 || lseek(file_, offset, SEEK_SET) < 0) {
    return invalid_input(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  }
  length_ = std::max<std::int64_t>(0, info.st_size - offset);
  if (mode == kPlain) return {};
  gzip_ = gzdopen(file_, "rb");
  if (!gzip_) return {StatusCode::kOutOfMemory, "out of memory while reading " + path};
  gzbuffer(gzip_, 1 << 17);
  inflating_ = !gzdirect(gzip_);
  return {};
}

std::int64_t ByteSource::most_bytes() const {
  constexpr std::int64_t kMostDeflation = 1032;  // no deflate stream expands more
  return (inflating_ ? length_ * kMostDeflation : length_) - read_;
}

Status ByteSource::read(void* bytes, std::size_t count) {
  auto* out = static_cast<std::byte*>(bytes);
  while (count > 0) {
    const auto wanted = static_cast<unsigned>(std::min(count, kBlock));
    const std::int64_t got =
        gzip_ ? gzread(gzip_, out, wanted) : static_cast<std::int64_t>(::read(file_, out, wanted));
    if (got < 0) {
      return invalid_input(fmt::format("cannot read {}: {}", path_,
                                       gzip_ ? "damaged gzip data" : std::strerror(errno)));
    }
    if (got == 0) {
      return invalid_input(
          fmt::format("{}: ends after {} bytes of what its header promises; {} are missing", path_,
                      read_, count));
    }
    out += got;
    count -= std::size_t(got);
    read_ += got;
  }
  return {};
}

Status ByteSource::skip(std::int64_t count) {
  std::vector<std::byte> block(std::size_t(std::min<std::int64_t>(count, kBlock)));
  while (count > 0) {
    const std::int64_t part = std::min<std::int64_t>(count, kBlock);
    if (Status s = read(block.data(), std::size_t(part)); !s.ok()) return s;
    count -= part;
  }
  return {};
}

const char* name_of(StoredType type) {
  constexpr const char* kNames[] = {"u8",  "i8",  "u16", "i16", "u32",
                                    "i32", "u64", "i64", "f32", "f64"};
  return kNames[int(type)];
}

std::size_t bytes_of(StoredType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[int(type)];
}

VoxelType voxel_type_of(StoredType stored) {
  switch (stored) {
    case StoredType::kU8:
      return VoxelType::kU8;
    case StoredType::kI16:
      return VoxelType::kI16;
    case StoredType::kU16:
      return VoxelType::kU16;
    default:
      return VoxelType::kF32;
  }
}

Status read_samples(ByteSource& source, StoredType stored, bool swap, VolumeImage* image) {
  if (Status s = check_geometry(*image); !s.ok()) return s;
  const std::size_t width = bytes_of(stored);
  const std::int64_t promised = image->voxels() * std::int64_t(width);
  if (promised > source.most_bytes()) {
    return invalid_input(fmt::format(
        "{}: its header promises {}x{}x{} samples of {}, {} bytes; the file holds at most {}",
        image->name, image->size[0], image->size[1], image->size[2], name_of(stored), promised,
        source.most_bytes()));
  }
  image->type = voxel_type_of(stored);
  image->stored_type = name_of(stored);
  const auto count = std::size_t(image->voxels());
  try {
    image->samples.resize(count * bytes_of(image->type));
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory,
            fmt::format("{}: {} voxels do not fit in memory; clip or coarsen it", image->name,
                        image->voxels())};
  }
  const bool as_stored = stored == StoredType::kU8 || stored == StoredType::kI16 ||
                         stored == StoredType::kU16 || stored == StoredType::kF32;
  if (as_stored) {
    if (Status s = source.read(image->samples.data(), image->samples.size()); !s.ok()) return s;
    if (swap && width > 1) swap_bytes(image->samples.data(), width, count);
    return {};
  }
  std::vector<std::byte> block(std::min(count, kBlock) * width);
  auto* values = reinterpret_cast<float*>(image->samples.data());
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t part = std::min(kBlock, count - begin);
    if (Status s = source.read(block.data(), part * width); !s.ok()) return s;
    if (swap && width > 1) swap_bytes(block.data(), width, part);
    to_float(stored, block.data(), part, values + begin);
  }
  return {};
}

}  // namespace obscura::tools
