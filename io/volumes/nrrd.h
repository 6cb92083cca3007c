#ifndef OBSCURA_IO_VOLUMES_NRRD_H_
#define OBSCURA_IO_VOLUMES_NRRD_H_

#include <span>

#include "io/volumes/planes.h"
#include "io/volumes/volume_image.h"

namespace obscura::tools {

// NRRD with its data attached (.nrrd) or in a file of their own (.nhdr); encodings raw, gzip and
// ascii; either byte order; three axes of scalars. Read here and not by a library: one clear
// message for each thing that can be wrong, and no trust in the header's sizes.
Status read_nrrd(const std::string& path, VolumeImage* image);

// The same without samples, and where they are; refuses files whose planes cannot be read one by
// one.
Status find_nrrd_planes(const std::string& path, VolumeImage* image, PlaneSamples* planes);

// Float fields on one grid of the world: a single one as three axes, several as four, the fields'
// axis first and as a list. The file is whole or not there.
struct NamedField {
  std::string name;
  std::vector<float> values;
};
struct FieldGrid {
  std::array<int, 3> size{};
  std::array<Double3, 3> axes{};
  Double3 origin{};
};
// The header; behind it come the floats, fields of a voxel beside each other.
std::string nrrd_field_header(const FieldGrid& grid, std::span<const std::string> names);
Status write_nrrd(const std::string& path, const FieldGrid& grid,
                  std::span<const NamedField> fields);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_NRRD_H_
