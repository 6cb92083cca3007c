#ifndef OBSCURA_IO_MESHES_FILE_BYTES_H_
#define OBSCURA_IO_MESHES_FILE_BYTES_H_

#include <string>

#include "obscura/status.h"

namespace obscura::tools {

// The whole of a file or FIFO, which is read once. Refuses folders and devices. Memory grows with
// what has been read, never by what a file says of itself.
Status read_file_bytes(const std::string& path, std::string* bytes);

// Inflates gzip data, members one after the other. Refuses what is not whole, and what inflates to
// more than 64 MiB and a hundred times its own size. `path` is for messages.
Status inflate_gzip(const std::string& path, const std::string& zipped, std::string* bytes);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_FILE_BYTES_H_
