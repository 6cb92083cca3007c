#ifndef OBSCURA_IO_VOLUMES_PLANES_H_
#define OBSCURA_IO_VOLUMES_PLANES_H_

#include <cstdint>
#include <optional>
#include <string>

#include "io/volumes/byte_source.h"
#include "io/volumes/volume_image.h"

namespace obscura::tools {

// What a .raw file does not contain: its layout. x runs fastest, samples are little-endian unless
// `big_endian`.
struct RawLayout {
  std::array<int, 3> size{};
  VoxelType type = VoxelType::kU8;
  Double3 spacing{1, 1, 1};
  bool big_endian = false;
};

// Where the samples of a volume lie, one plane after another.
struct PlaneSamples {
  std::string file;
  std::int64_t offset = 0;  // of the first plane, in bytes
  StoredType stored{};
  bool swap = false;
};

// A volume of raw samples in one file (.raw, .nrrd, .nhdr), of which planes are read as they are
// wanted: it may be larger than memory, and several processes may each read theirs.
class PlaneFile {
 public:
  // Whatever the name says; `raw` for .raw files only.
  Status open(const std::string& path, const std::optional<RawLayout>& raw);
  Status open_raw(const std::string& path, const RawLayout& layout);

  // Everything but the samples.
  const VolumeImage& volume() const { return volume_; }
  // Planes begin ... end - 1 as a volume. A file that has become shorter meanwhile is an error.
  Status read(int begin, int end, VolumeImage* slab) const;

 private:
  VolumeImage volume_;
  PlaneSamples samples_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_PLANES_H_
