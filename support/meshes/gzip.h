#ifndef OBSCURA_SUPPORT_MESHES_GZIP_H_
#define OBSCURA_SUPPORT_MESHES_GZIP_H_

#include <string>

#include "obscura/status.h"

namespace obscura::support {

// The whole file, inflated. Refuses what is not whole gzip data and more than 4 GiB of it.
Status read_gzip(const std::string& path, std::string* contents);

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_MESHES_GZIP_H_
