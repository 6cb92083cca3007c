#ifndef OBSCURA_IO_VOLUMES_VDB_H_
#define OBSCURA_IO_VOLUMES_VDB_H_

#include "io/volumes/nrrd.h"

namespace obscura::tools {

// Whether this build can read and write OpenVDB files.
bool has_openvdb();

// The first scalar grid of a .vdb file (float, double, int32, int64 or bool), as dense samples over
// the box of its active voxels; inactive ones take the grid's own values there. A level set brings
// its isovalue, 0, and its side, below.
Status read_vdb(const std::string& path, VolumeImage* image);

// One float grid per field, each under its name. The file is whole or not there.
Status write_vdb(const std::string& path, const FieldGrid& grid,
                 std::span<const NamedField> fields);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_VDB_H_
