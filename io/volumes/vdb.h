#ifndef OBSCURA_IO_VOLUMES_VDB_H_
#define OBSCURA_IO_VOLUMES_VDB_H_

#include <string>

#include "io/volumes/nrrd.h"

namespace obscura::tools {

// Whether this build can read and write OpenVDB files.
bool has_openvdb();

// A scalar grid of a .vdb file (float, double, int32, int64 or bool) as dense samples over the box
// of its active voxels; what lies outside active voxels is the grid's background, but for level
// sets, whose inside is not active. `grid` names it; where that is empty, the one named "density"
// is read, else the first that is not the same everywhere. image->notes lists several grids. A
// level set brings its isovalue, 0, and its side, below.
//
// The program obscura-vdb does the reading, within limits of memory and time: a damaged file may do
// anything to OpenVDB.
Status read_vdb(const std::string& path, const std::string& grid, VolumeImage* image);

// One float grid per field, each under its name. The file is whole or not there.
Status write_vdb(const std::string& path, const FieldGrid& grid,
                 std::span<const NamedField> fields);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_VDB_H_
