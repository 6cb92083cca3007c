#ifndef OBSCURA_IO_VOLUMES_NRRD_HEADER_H_
#define OBSCURA_IO_VOLUMES_NRRD_HEADER_H_

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "obscura/status.h"

namespace obscura::tools {

struct NrrdHeader {
  std::map<std::string, std::string> fields;  // keys in lower case
  std::int64_t end = 0;                       // position after the blank line
  std::vector<std::string> data_files;        // of "data file: LIST"

  std::string get(const std::string& key) const {
    const auto at = fields.find(key);
    return at == fields.end() ? "" : at->second;
  }
};

Status read_nrrd_header(const std::string& path, NrrdHeader* header);

// Where the samples begin: the files, slabs of the last axis in order, and the position in them.
Status find_nrrd_data(const std::string& path, const NrrdHeader& header,
                      std::vector<std::string>* data, std::int64_t* offset);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_NRRD_HEADER_H_
