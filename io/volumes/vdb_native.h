#ifndef OBSCURA_IO_VOLUMES_VDB_NATIVE_H_
#define OBSCURA_IO_VOLUMES_VDB_NATIVE_H_

#include <functional>

#include "io/volumes/vdb.h"

namespace obscura::tools {

// As read_vdb, in this process: OpenVDB 10 trusts the bytes of a file, so that a damaged one may
// crash, hang or fill the memory. For obscura-vdb only, whose limits end that. `memory` is called
// with the bytes that the dense samples need before they are taken.
Status read_vdb_trusting(const std::string& path, const std::string& grid,
                         const std::function<void(double)>& memory, VolumeImage* image);

// What obscura-vdb writes and read_vdb reads: lines of text up to an empty one, then the samples.
std::string write_vdb_header(const Status& status, const VolumeImage& image);
Status parse_vdb_header(const std::string& path, const std::string& text, VolumeImage* image);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_VDB_NATIVE_H_
