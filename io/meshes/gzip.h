#ifndef OBSCURA_IO_MESHES_GZIP_H_
#define OBSCURA_IO_MESHES_GZIP_H_

#include <string>

#include "obscura/status.h"

namespace obscura::tools {

// The whole file, inflated. Refuses what is not whole gzip data and more than 4 GiB of it.
Status read_gzip(const std::string& path, std::string* contents);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_GZIP_H_
