#ifndef OBSCURA_IO_VOLUMES_BYTE_SOURCE_H_
#define OBSCURA_IO_VOLUMES_BYTE_SOURCE_H_

#include <zlib.h>

#include <cstdint>
#include <string>

#include "io/volumes/volume_image.h"
#include "obscura/status.h"

namespace obscura::tools {

// Bytes of a file from a position on, inflated where they are gzip data and that is asked for.
class ByteSource {
 public:
  enum Mode { kPlain, kGunzip };  // kGunzip passes through what is not gzip data

  ByteSource() = default;
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  Status open(const std::string& path, Mode mode, std::int64_t offset = 0);

  // Reads exactly `count` bytes; fails when the file ends before or its data are damaged.
  Status read(void* bytes, std::size_t count);
  Status skip(std::int64_t count);

  // No more bytes than this can still come (for gzip data a bound from the file's length).
  std::int64_t most_bytes() const;

 private:
  std::string path_;
  int file_ = -1;
  gzFile gzip_ = nullptr;
  std::int64_t length_ = 0;  // of the file from the offset on
  std::int64_t read_ = 0;
  bool inflating_ = false;
};

// Sample types that files hold.
enum class StoredType { kU8, kI8, kU16, kI16, kU32, kI32, kU64, kI64, kF32, kF64 };
const char* name_of(StoredType type);
std::size_t bytes_of(StoredType type);

// Where the volume keeps samples of a stored type.
VoxelType voxel_type_of(StoredType stored);

// Checks the geometry, then that the source can hold the samples, and reads them; `swap` reverses
// the bytes of each.
Status read_samples(ByteSource& source, StoredType stored, bool swap, VolumeImage* image);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_BYTE_SOURCE_H_
