#ifndef OBSCURA_APPS_OBSCURA_SCRATCH_FILE_H_
#define OBSCURA_APPS_OBSCURA_SCRATCH_FILE_H_

#include <cstdint>
#include <string>

#include "obscura/status.h"

namespace obscura::app {

// A file that is written and read at positions.
class ScratchFile {
 public:
  ScratchFile() = default;
  ~ScratchFile() { close(); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  Status create(const std::string& path);  // empty
  Status open(const std::string& path);
  Status write(std::int64_t at, const void* bytes, std::int64_t count);
  Status read(std::int64_t at, void* bytes, std::int64_t count) const;
  void close();

 private:
  Status opened(const std::string& path, int flags);

  std::string path_;
  int file_ = -1;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_SCRATCH_FILE_H_
